#include "io/usd/stage/UsdReport.h"

#include "io/usd/layer/UsdPath.h"
#include "io/usd/stage/UsdComposedPrim.h"
#include "io/usd/stage/UsdTargets.h"

#include <algorithm>
#include <deque>
#include <unordered_map>

namespace penumbra {

namespace {

std::string shortName(const UsdComposition& composition, const std::filesystem::path& file) {
    const std::filesystem::path first = composition.rootStack().layers.front().file;
    const auto root = first.parent_path();
    const auto relative = file.lexically_normal().lexically_relative(root.lexically_normal());
    return (relative.empty() ? file : relative).generic_string(); // one is absolute, one is not
}

bool isIdentity(const UsdLayerOffset& offset) {
    return offset.offset == 0 && offset.scale == 1;
}

// A prim's index and what is known of it while it is reported.
class PrimReporter {
public:
    PrimReporter(UsdComposition& composition, UsdPrimIndex& index)
        : composition_(composition), index_(index), stack_(primStack(index)) {}

    UsdPrimReport report() {
        report_.path = index_.path().text();
        for (const UsdComposedSpec& one : stack_)
            report_.primStack.emplace_back(name(*one.layer), index_[one.node].path.text());
        addTimes();
        auto names = childNames(index_);
        report_.childNames = std::move(names.names);
        report_.prohibited = std::move(names.prohibited);
        addVariants();
        addProperties();
        return std::move(report_);
    }

private:
    std::string name(const UsdStackedLayer& layer) const {
        return shortName(composition_, layer.file);
    }

    void addTimes() {
        bool any = false;
        for (const std::uint32_t node : index_.strengthOrder()) {
            const UsdNode& n = index_[node];
            if (!n.speaks() || (node != 0 && !n.hasSpecs)) continue;
            UsdTimeReport time{name(n.stack->layers.front()),
                               n.path.text(),
                               nameOf(n.arc),
                               index_.toRoot(node).offset(),
                               {}};
            for (const UsdStackedLayer& layer : n.stack->layers)
                if (!isIdentity(layer.offset))
                    time.children.push_back({name(layer), {}, "sublayer", layer.offset, {}});
            any = any || !isIdentity(time.offset) || !time.children.empty();
            report_.times.push_back(std::move(time));
        }
        if (!any) report_.times.clear();
    }

    void addVariants() {
        for (const std::uint32_t node : index_.strengthOrder()) {
            const UsdSitePath path = index_[node].path;
            if (index_[node].arc == UsdArc::variant && path.isChoice())
                report_.variants.try_emplace(path.name(), path.choice());
        }
    }

    void addProperties() {
        std::unordered_map<std::string, std::vector<const UsdComposedSpec*>> sites;
        for (std::size_t i = stack_.size(); i-- > 0;)
            for (const UsdProperty& property : stack_[i].spec->properties) {
                auto& list = sites[property.name];
                if (list.empty()) report_.properties.push_back(property.name);
                list.push_back(&stack_[i]);
            }
        for (const std::string& property : report_.properties) {
            auto& list = sites[property];
            std::reverse(list.begin(), list.end());
            addProperty(property, list);
        }
    }

    void addProperty(const std::string& property, std::vector<const UsdComposedSpec*> sites) {
        const std::string path = report_.path + "." + property;
        const bool relationship = sites.front()->spec->property(property)->relationship;
        std::erase_if(sites, [&](const UsdComposedSpec* site) {
            const UsdProperty& found = *site->spec->property(property);
            if (found.relationship == relationship) return false;
            error(*site, found, "ignored: a stronger layer has <" + path + "> of another kind");
            return true;
        });
        std::vector<UsdTargetOpinion> opinions;
        auto& list = report_.propertyStacks[path];
        for (const UsdComposedSpec* site : sites) {
            list.emplace_back(name(*site->layer), index_[site->node].path.text() + "." + property);
            opinions.push_back({site->spec->property(property), &index_.toRoot(site->node)});
        }
        auto targets = composeTargets(opinions, [&](std::size_t i, const std::string& target) {
            return !isInstanceTarget(*sites[i], target);
        });
        for (const auto& [i, target] : targets.unmapped) {
            std::string text = "target <";
            text.append(target).append("> of <").append(path);
            text += "> is outside of what the arc brings";
            error(*sites[i], *opinions[i].property, text);
        }
        if (!targets.paths.empty())
            (relationship ? report_.targets : report_.connections)[path] = std::move(targets.paths);
        if (!targets.deleted.empty()) report_.deleted[path] = std::move(targets.deleted);
    }

    void error(const UsdComposedSpec& site, const UsdProperty& property, const std::string& text) {
        composition_.errors().setPrim(report_.path);
        composition_.errors().report(site.layer->layer->location(property.where), text);
    }

    // Whether a target that is written in an inherited class, pointing out of it, is a prim that
    // inherits the class.
    bool isInstanceTarget(const UsdComposedSpec& site, const std::string& target) {
        std::uint32_t node = site.node;
        while (node != kNoNode && index_[node].arc != UsdArc::inherit) node = index_[node].parent;
        if (node == kNoNode) return false;
        const UsdSitePath root = index_.path().root();
        const UsdSitePath prim = root.fromText(usdPrimPart(target));
        const UsdSitePath begin = index_.pathAtIntroduction(node);
        const UsdSitePath inside = index_.toRoot(node).mapBack(prim);
        if (!prim || !inside || inside.hasPrefix(begin.plain())) return false;
        return inherits(prim, index_[node].stack, begin);
    }

    bool inherits(UsdSitePath prim, const UsdLayerStack* stack, UsdSitePath site) {
        UsdPrimIndex index = composition_.root();
        for (std::size_t length = 1; length <= prim.length(); ++length)
            index = composition_.child(index, prim.prefix(length).name());
        for (std::uint32_t node = 0; node < index.nodes.size(); ++node)
            if (index[node].arc == UsdArc::inherit && index[node].stack == stack &&
                index.pathAtIntroduction(node) == site)
                return true;
        return false;
    }

    UsdComposition& composition_;
    UsdPrimIndex& index_;
    std::vector<UsdComposedSpec> stack_;
    UsdPrimReport report_;
};

} // namespace

std::vector<std::string> layerNames(const UsdComposition& composition) {
    std::vector<std::string> names;
    for (const UsdStackedLayer& layer : composition.rootStack().layers)
        names.push_back(shortName(composition, layer.file));
    return names;
}

void reportComposition(UsdComposition& composition,
                       const std::function<void(const UsdPrimReport&)>& take) {
    struct Open {
        std::shared_ptr<const UsdPrimIndex> parent;
        std::string name;
    };
    std::deque<Open> open;
    const auto root = std::make_shared<const UsdPrimIndex>(composition.root());
    for (std::string& name : childNames(*root).names) open.push_back({root, std::move(name)});
    const UsdComposeLimits& limits = composition.limits();
    std::size_t opinions = 0;
    for (std::size_t prims = 0; !open.empty(); ++prims) {
        if (prims == limits.prims || opinions > limits.opinions) {
            composition.errors().report({composition.rootStack().rootLayer().file, 0, 0},
                                        "the composed scene is too large: its report ends here");
            return;
        }
        const Open next = std::move(open.front());
        open.pop_front();
        auto index = std::make_shared<UsdPrimIndex>(composition.child(*next.parent, next.name));
        const UsdPrimReport report = PrimReporter(composition, *index).report();
        take(report);
        opinions += report.primStack.size();
        if (index->path().levels() >= limits.levels) {
            if (report.childNames.empty()) continue;
            composition.errors().setPrim(report.path);
            composition.errors().report({composition.rootStack().rootLayer().file, 0, 0},
                                        "<" + report.path + ">: prims nested too deeply: those " +
                                            "below this one are left out of the report");
            continue;
        }
        for (std::size_t i = report.childNames.size(); i-- > 0;)
            open.push_front({index, report.childNames[i]});
    }
}

} // namespace penumbra
