#include "Flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace penumbra {

namespace {

using Kernel = std::vector<double>; ///< of odd length, its middle at 0

Kernel kernel(int radius, const std::function<double(int)>& weight) {
    Kernel result;
    for (int x = -radius; x <= radius; ++x) result.push_back(weight(x));
    return result;
}

/// Positive weights sum to 1, negative ones to -1.
void normalise(Kernel& weights) {
    double positive = 0, negative = 0;
    for (double w : weights) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : weights) w /= w > 0 ? positive : std::max(negative, 1e-300);
}

Plane filtered(const Plane& picture, const Kernel& across, const Kernel& down) {
    const auto pass = [](const Plane& in, const Kernel& weights, int dx, int dy) {
        Plane out(in.width, in.height);
        const int radius = int(weights.size() / 2);
        for (int y = 0; y < in.height; ++y)
            for (int x = 0; x < in.width; ++x) {
                double sum = 0;
                for (int k = -radius; k <= radius; ++k)
                    sum += weights[std::size_t(k + radius)] *
                           in.at(std::clamp(x + k * dx, 0, in.width - 1),
                                 std::clamp(y + k * dy, 0, in.height - 1));
                out.at(x, y) = float(sum);
            }
        return out;
    };
    return pass(pass(picture, across, 1, 0), down, 0, 1);
}

double lightness(double y) { // CIE 1976 L*
    const double limit = 6.0 / 29;
    const double f = y > limit * limit * limit ? std::cbrt(y) : y / (3 * limit * limit) + 4.0 / 29;
    return 116 * f - 16;
}

/// How strongly a picture changes at each pixel, in either direction.
Plane feature(const Plane& picture, const Kernel& along, const Kernel& across) {
    const Plane x = filtered(picture, along, across), y = filtered(picture, across, along);
    Plane strength(picture.width, picture.height);
    for (std::size_t i = 0; i < strength.values.size(); ++i)
        strength.values[i] = std::hypot(x.values[i], y.values[i]);
    return strength;
}

double colourDifference(double test, double reference) {
    // Largest distance there is, between green and blue, in Hunt-adjusted L*a*b*: 203.3.
    const double most = std::pow(203.3, 0.7), knee = 0.4 * most;
    const double distance = std::abs(lightness(std::clamp(test, 0.0, 1.0)) -
                                     lightness(std::clamp(reference, 0.0, 1.0)));
    const double error = std::pow(distance, 0.7);
    return error < knee ? 0.95 * error / knee : 0.95 + 0.05 * (error - knee) / (most - knee);
}

} // namespace

Plane flip(const Plane& test, const Plane& reference, double pixelsPerDegree) {
    constexpr double pi = std::numbers::pi;
    // Contrast sensitivity of the luminance channel, b = 0.0047; as wide as that of colours.
    Kernel eye =
        kernel(int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixelsPerDegree)), [&](int x) {
            const double degrees = x / pixelsPerDegree;
            return std::exp(-pi * pi * degrees * degrees / 0.0047);
        });
    normalise(eye);
    const double sigma = 0.5 * 0.082 * pixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    const auto gauss = [&](int x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    Kernel spread = kernel(radius, gauss);
    Kernel edge = kernel(radius, [&](int x) { return -x * gauss(x); });
    Kernel point = kernel(radius, [&](int x) { return (x * x / (sigma * sigma) - 1) * gauss(x); });
    for (Kernel* each : {&spread, &edge, &point}) normalise(*each);

    const Plane a = filtered(test, eye, eye), b = filtered(reference, eye, eye);
    const Plane edgesA = feature(test, edge, spread), edgesB = feature(reference, edge, spread);
    const Plane pointsA = feature(test, point, spread), pointsB = feature(reference, point, spread);
    Plane result(test.width, test.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const double features = std::max(std::abs(edgesA.values[i] - edgesB.values[i]),
                                         std::abs(pointsA.values[i] - pointsB.values[i]));
        const double exponent = 1 - std::sqrt(features / std::numbers::sqrt2);
        result.values[i] = float(std::pow(colourDifference(a.values[i], b.values[i]), exponent));
    }
    return result;
}

} // namespace penumbra
