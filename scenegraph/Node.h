// One entry of the scene graph.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace penumbra {

class Visitor;

/// One entry of the scene graph. The graph is a DAG: a node may have several parents (that is how
/// objects are instanced) and so holds no pointer up. A place in the scene is a path from the root.
///
/// Who keeps pointers to nodes of a graph that is edited keeps them alive by shared_from_this():
/// else another node may come to lie where one was.
class Node : public std::enable_shared_from_this<Node> {
public:
    explicit Node(std::string name) : name_(std::move(name)) {}
    virtual ~Node() = default;
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    virtual void accept(Visitor& visitor) const = 0;
    const std::string& name() const { return name_; }

    /// Rises each time this node, not its children, is edited. Readers keep the last value they
    /// saw.
    std::uint64_t revision() const { return revision_; }

protected:
    void touch() { ++revision_; }

private:
    std::string name_;
    std::uint64_t revision_ = 1;
};

using NodePtr = std::shared_ptr<Node>;

} // namespace penumbra
