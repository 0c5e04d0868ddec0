// Walking the graph.
#pragma once

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace penumbra {

class Node;
class Group;
class Switch;
class Transform;
class Mesh;
class Light;
class Camera;
class LitGeometry;

/// Walks a graph depth first, children in order, skipping what a Switch hides. It carries its own
/// transform stack and path, since nodes know neither their parents nor their paths. Override what
/// you want to see and call traverse() to go on below.
class Visitor {
public:
    virtual ~Visitor() = default;

    virtual void visit(const Group& group);
    virtual void visit(const Switch& node);
    virtual void visit(const Transform& transform);
    virtual void visit(const Mesh&) {}
    virtual void visit(const Light&) {}
    virtual void visit(const Camera&) {}
    virtual void visit(const LitGeometry&) {}

protected:
    /// Visits the children of `group`; inside them path() ends with the child's name.
    void traverse(const Group& group);

    /// Local frame of the node being visited to the root's frame (column vectors). A Transform's
    /// own matrix comes on top of it when its children are visited.
    const glm::dmat4& toWorld() const { return matrices_.back(); }
    /// Names from below the root to the node being visited, e.g. "/World/Seat/Cushion". A node
    /// without a name has no part in it: it shares the path of the one above.
    std::string path() const;
    const std::vector<const Node*>& nodePath() const { return nodes_; }

private:
    std::vector<glm::dmat4> matrices_{glm::dmat4(1.0)};
    std::vector<const Node*> nodes_;
};

} // namespace penumbra
