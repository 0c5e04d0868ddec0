// Draws lit surfaces whose light changes while something moves.
#pragma once

#include "viewer/gl/GeometryCache.h"
#include "viewer/gl/LitItem.h"
#include "viewer/gl/ShaderProgram.h"
#include "viewer/gl/TextureCache.h"
#include "viewer/preview/Preview.h"
#include "viewer/shadowmaps/IndexRuns.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace penumbra {

/// PreviewLighting by the graphics card: shadow maps of what moves, tight around it, and of what
/// is in the same light, for each scene state; and a program that adds the change of the light
/// to what vertices carry. It is used for those triangles alone that a change may reach: whose
/// shaft to a light meets what moves; all others are drawn as ever.
class MapPreview : public Preview {
public:
    MapPreview();
    ~MapPreview() override;

    PreviewMethod method() const override { return PreviewMethod::maps; }
    void takeBack() override {} ///< nothing: the shader adds what it does
    void update(const PreviewLighting& light, const ShownOf& shown, const View* view) override;
    void rest(const PreviewLighting& expected, const ShownOf& shown, const View* view) override;

    /// Whether there is anything to be drawn by draw().
    bool active() const { return light_.active(); }
    /// Draws the shadow maps that are not there yet, in a context that is current from now on until
    /// the end. Leaves no framebuffer bound. \pre active() \return how many it drew
    std::size_t prepare(GeometryCache& cache);

    /// Which lights' change may reach a triangle of a chunk, a bit a light. After prepare(), before
    /// the next.
    unsigned reaching(const LitItem& item, const TriangleChunk& chunk) const;

    /// Triangles of one range of an item that the same lights reach.
    struct Runs {
        std::size_t item = 0, range = 0;
        unsigned lights = 0;
        IndexRuns runs;
    };
    /// \param runs by item
    void draw(const std::vector<LitItem>& items, const std::vector<Runs>& runs,
              TextureCache& textures);

private:
    struct Impl;

    PreviewLighting light_;
    std::unique_ptr<Impl> impl_; ///< when it is needed first: may belong to no context yet
};

} // namespace penumbra
