// [Lambert1760], [Baum1989], [Howell] as in radiosity/FormFactor.cpp, which says more; shadows from
// several points of a light after [HeckbertHerf1997].
#include "viewer/shadowmaps/PreviewShaders.h"

namespace penumbra {

namespace {

const char* const kFormFactors = R"(
const float kPi = 3.14159265359;

uniform sampler2D previewTable;

vec4 entry(int row, int i) { return texelFetch(previewTable, ivec2(i, row), 0); }

vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

float angleOverSine(float cosine, vec3 axis) {
    if (cosine < 0.0) {
        float sine = length(axis);
        return sine > 0.0 ? atan(sine, cosine) / sine : 0.0;
    }
    float p = -0.0012624911;             // Abramowitz & Stegun 4.4.46
    p = p * cosine + 0.0066700901;
    p = p * cosine - 0.0170881256;
    p = p * cosine + 0.0308918810;
    p = p * cosine - 0.0501743046;
    p = p * cosine + 0.0889789874;
    p = p * cosine - 0.2145988016;
    p = p * cosine + 1.5707963050;
    return p * inversesqrt(1.0 + cosine);
}

float edge(vec3 a, vec3 b, vec3 n) {     // a, b unit
    vec3 axis = cross(b, a);
    return dot(n, axis) * angleOverSine(dot(a, b), axis);
}

// The contour of a convex polygon above the horizon, edge by edge; what the horizon cuts off is
// closed by the edge from where the outline leaves to where it comes up again.
struct Contour { float sum; vec3 leaves, comes; bool cut; };

void follow(inout Contour c, vec3 a, vec3 b, vec3 n) {
    float ha = dot(n, a), hb = dot(n, b);
    if (ha < 0.0 && hb < 0.0) return;
    vec3 s = a, e = b;
    vec3 at = a + clamp(ha / (ha - hb), 0.0, 1.0) * (b - a);
    if (ha < 0.0) { s = at; c.comes = at; c.cut = true; }
    if (hb < 0.0) { e = at; c.leaves = at; c.cut = true; }
    c.sum += edge(unit(s), unit(e), n);
}

float closed(Contour c, vec3 n) {
    float sum = c.sum + (c.cut ? edge(unit(c.leaves), unit(c.comes), n) : 0.0);
    return max(sum, 0.0) * (0.5 / kPi);
}

float quadFactor(int row, vec3 p, vec3 n) {
    vec3 a = entry(row, 1).xyz - p, b = entry(row, 2).xyz - p;
    vec3 c = entry(row, 3).xyz - p, d = entry(row, 4).xyz - p;
    vec3 middle = 0.25 * (a + b + c + d);
    vec3 area = 0.5 * cross(c - a, d - b);
    float d2 = dot(middle, middle);
    if (max(dot(c - a, c - a), dot(d - b, d - b)) * 3600.0 < d2) // the edges' terms cancel
        return max(dot(n, middle), 0.0) * max(-dot(area, middle), 0.0) / (kPi * d2 * d2);
    Contour contour = Contour(0.0, vec3(0.0), vec3(0.0), false);
    follow(contour, a, b, n);
    follow(contour, b, c, n);
    follow(contour, c, d, n);
    follow(contour, d, a, n);
    return closed(contour, n);
}

// root^2 = (h^2 + a^2 - R^2)^2 + (2 h R)^2, written such that nothing cancels far away.
float diskFactor(vec3 p, vec3 n, vec3 centre, vec3 axis, float radius) {
    vec3 way = centre - p;
    float h = -dot(way, axis);
    float cosTilt = -dot(n, axis);
    float reach = radius * sqrt(max(0.0, 1.0 - cosTilt * cosTilt));
    float height = dot(n, way);
    if (h <= 0.0 || height <= -reach) return 0.0;
    vec3 lateral = way + h * axis;
    float r2 = radius * radius, a2 = dot(lateral, lateral);
    float m = h * h + a2 - r2;
    float root = sqrt(m * m + 4.0 * h * h * r2);
    float along = m > 0.0 ? 2.0 * h * h * r2 / (root * (root + m)) : 0.5 * (1.0 - m / root);
    float across = 2.0 * h * r2 * dot(n, lateral) / (root * (h * h + a2 + r2 + root));
    float whole = max(along * cosTilt + across, 0.0);
    int sides = height < reach ? 24 : 0; // cut by the horizon: a polygon of the same area
    vec3 u = unit(abs(axis.x) < 0.7 ? vec3(0.0, axis.z, -axis.y) : vec3(-axis.z, 0.0, axis.x));
    vec3 v = cross(axis, u);
    const float kStep = 2.0 * kPi / 24.0;
    float wide = radius * sqrt(kStep / sin(kStep));
    Contour contour = Contour(0.0, vec3(0.0), vec3(0.0), false);
    vec3 first = way + wide * u, from = first;
    for (int i = 1; i <= sides; ++i) { // it ends where it began, bit for bit: a corner on the
        float turn = float(i) * kStep; // horizon is on the same side of it both times
        vec3 to = i < sides ? way + wide * (cos(turn) * u + sin(turn) * v) : first;
        follow(contour, from, to, n);
        from = to;
    }
    return sides > 0 ? closed(contour, n) : whole;
}

// A sphere is seen as the disk in which the tangent cone touches it. One call for both: where the
// processor draws, both sides of a branch are worked out.
float formFactor(int row, vec3 p, vec3 n) {
    int kind = int(entry(row, 0).x);
    if (kind == 0) return 0.0;
    vec4 centre = entry(row, 1);
    vec3 middle = centre.xyz, axis = entry(row, 2).xyz, way = centre.xyz - p;
    float radius = centre.w, r2 = radius * radius, d2 = dot(way, way);
    bool sphere = kind == 3;
    if (sphere) {
        axis = -way * inversesqrt(d2);
        middle += axis * (r2 * inversesqrt(d2));
        radius *= sqrt(max(0.0, 1.0 - r2 / d2));
    }
    float factor = kind == 1 ? quadFactor(row, p, n) : diskFactor(p, n, middle, axis, radius);
    return sphere && d2 <= r2 ? 0.0 : factor;
}
)";

const char* const kShadows = R"(
uniform sampler2DArray movedMaps, fixedMaps;
uniform int tightPoints;
uniform float tightTile, cubeTile;       // texels
uniform int cubePoints;

// Whether anything of the sphere of what moves may be seen in front of the sphere of the light.
bool inShadowCone(vec3 p, vec4 light, vec4 thing) {
    vec3 l = light.xyz - p, t = thing.xyz - p;
    float l2 = dot(l, l), t2 = dot(t, t);
    float sl = light.w * inversesqrt(l2), st = thing.w * inversesqrt(t2);
    if (sl >= 1.0 || st >= 1.0) return true;
    float both = sqrt((1.0 - sl * sl) * (1.0 - st * st)) - sl * st;
    return sl + st >= 1.0 || dot(l, t) * inversesqrt(l2 * t2) >= both;
}

int mostOf(vec3 v) {
    vec3 a = abs(v);
    return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

// How a tile of a map looks at the scene.
struct MapView {
    vec3 right, up, axis;
    int tile;
};

// The view from point k of a light along d: of a cube, the face that d goes through.
MapView viewTo(vec3 d, int row, int k, bool cube) {
    if (!cube) return MapView(entry(row, 7).xyz, entry(row, 8).xyz, entry(row, 9).xyz, k);
    int i = mostOf(d);
    bool back = d[i] < 0.0;
    MapView view = MapView(vec3(0.0), vec3(0.0), vec3(0.0), 6 * k + 2 * i + (back ? 1 : 0));
    view.axis[i] = back ? -1.0 : 1.0;
    view.right[(i + 1) % 3] = 1.0;
    view.up[(i + 2) % 3] = 1.0;
    return view;
}

// How much of a light a point does not see because of what moves (of: own, or cube views, because
// of anything at all): of its points, weighed by cos cos / d^2 as radiosity weighs its samples.
//
// A map is compared with the receiver's plane at the middle of the texel: a plane casts no shadow
// on itself, however coarse the map, and the margin can be less than a texel is wide. A point that
// lies all but in that plane is taken to be seen: within a texel the plane goes through all depths,
// and a map can't tell it from what is in front of it.
float hidden(int row, vec3 p, vec3 n, bool own) {
    bool cube = entry(row, 0).y > 0.5;
    float grain = entry(row, 9).w, size = cube ? cubeTile : tightTile;
    vec4 lightNormal = entry(row, 10), ranges = entry(row, 11);
    int tiles = cube ? 5 : 4;
    int count = cube ? cubePoints
              : inShadowCone(p, entry(row, 5), entry(row, 6)) ? tightPoints : 0;
    float total = 0.0, dark = 0.0;
    for (int k = 0; k < count; ++k) {
        vec4 from = entry(row, 12 + 2 * k), window = entry(row, 13 + 2 * k);
        vec3 d = p - from.xyz;
        MapView view = viewTo(d, row, k, cube);
        vec2 scale = vec2(from.w, window.x), offset = window.yz;
        float here = -dot(n, d), d2 = dot(d, d);
        float there = lightNormal.xyz == vec3(0.0) ? sqrt(d2) : dot(lightNormal.xyz, d);
        float weight = max(here, 0.0) * max(there, 0.0) / (d2 * d2);
        total += weight;
        float z = dot(d, view.axis);
        vec2 at = vec2(dot(d, view.right), dot(d, view.up)) / z * scale + offset;
        bool covered = z > 0.0 && all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
        vec2 texel = clamp(floor(at * size), vec2(0.0), vec2(size - 1.0));
        vec2 middle = ((texel + 0.5) / size - offset) / scale;
        vec3 across = view.axis + view.right * middle.x + view.up * middle.y;
        float inverse = dot(n, across) / min(-here, -1e-6);
        bool tells = inverse > 0.8 / z && inverse < 1.25 / z;
        inverse = clamp(inverse, 0.8 / z, 1.25 / z);
        inverse += (1e-3 + grain * z) * inverse * inverse;
        ivec3 place = ivec3(ivec2(texel) + ivec2(view.tile % tiles, view.tile / tiles) * int(size),
                            int(lightNormal.w));
        float fixedDepth = texelFetch(fixedMaps, place, 0).r;
        float movedDepth = texelFetch(movedMaps, place, 0).r;
        bool byFixed = fixedDepth < 1.0 && fixedDepth < ranges.z - ranges.w * inverse;
        bool byMoved = !cube && movedDepth < 1.0 && movedDepth < ranges.x - ranges.y * inverse;
        bool counts = covered && tells && (own || cube ? byFixed || byMoved : byMoved && !byFixed);
        dark += counts ? weight : 0.0;
    }
    return total > 0.0 ? dark / total : 0.0;
}
)";

const char* const kChange = R"(
uniform int previewedLights, anchorCount;
uniform int lightList[4];                // those that reach what is drawn
uniform vec4 exitances[4];               // lm/m^2
uniform vec4 anchorShares[4];            // of anchor 1 ... 3: x of rest, y of what is left behind
uniform mat4 posesInMaps[4];             // of the geometry, then and now
uniform mat3 normalsInMaps[4];
uniform int ownMoves;

vec3 lightChange(vec3 position, vec3 normal, vec4 held, float behind) {
    vec3 sum = vec3(0.0);
    vec3 p = vec3(posesInMaps[0] * vec4(position, 1.0)), n = unit(normalsInMaps[0] * normal);
    for (int i = 0; i < previewedLights; ++i) {
        int light = lightList[i];
        float most = formFactor(light, p, n);
        float now = most * (1.0 - hidden(light, p, n, ownMoves != 0));
        float f = held[light], change = 0.0, mostThen = most;
        for (int s = 1; s <= anchorCount; ++s) {
            int row = 4 * s + light;
            vec3 then = vec3(posesInMaps[s] * vec4(position, 1.0));
            vec3 up = unit(normalsInMaps[s] * normal);
            float share = mix(anchorShares[s].x, anchorShares[s].y, behind);
            float most1 = formFactor(row, then, up);
            change += share * (now - most1 * (1.0 - hidden(row, then, up, ownMoves != 0)));
            mostThen += share * (most1 - most);
        }
        if (f >= 0.0)
            change = clamp(f + change, 0.0, most + max(0.0, f - mostThen)) - f;
        sum += change * exitances[light].rgb;
    }
    return sum;
}
)";

const char* const kInputs = R"(#version 330 core
layout(location = 0) in vec3 position;   // local frame
layout(location = 1) in vec3 normal;     // local frame, unit
layout(location = 2) in vec3 direct;     // lux
layout(location = 3) in vec3 indirect;   // lux
layout(location = 4) in vec4 factors;
layout(location = 5) in float behind;
layout(location = 6) in vec2 uv;

uniform mat4 localToClip;
)";

const char* const kVertexMain = R"(
centroid out vec3 surfaceDirect;
centroid out vec3 surfaceIndirect;
out vec2 surfaceUv;

void main() {
    gl_Position = localToClip * vec4(position, 1.0);
    surfaceDirect = max(direct + lightChange(position, normal, factors, behind), 0.0);
    surfaceIndirect = indirect;
    surfaceUv = uv;
}
)";

} // namespace

std::string previewVertexShader() {
    return std::string(kInputs) + kFormFactors + kShadows + kChange + kVertexMain;
}

} // namespace penumbra
