// Whether a scene that was edited is left.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace penumbra {

/// What takes the place of the scene that is shown.
struct Departure {
    enum class To { another, itselfAgain, nothing };
    To to = To::nothing;
    std::string file = {}; ///< of another scene
    bool operator==(const Departure&) const = default;
};

/// Edits are lost when another scene is opened, the same file is read again, or the program ends:
/// people are asked first, and may save them.
class LeaveQuestion {
public:
    enum class Answer { save, discard, cancel };

    /// \return whether to go at once: nothing would be lost, or the end is asked for once more
    /// while the question stands
    bool ask(Departure next, bool unsaved) {
        const bool insists = next.to == Departure::To::nothing && next_ == next;
        const bool go = !unsaved || insists;
        next_ = go ? std::nullopt : std::optional(std::move(next));
        return go;
    }
    /// What the question is about while it stands.
    const std::optional<Departure>& next() const { return next_; }

    /// \param save what saves the edits, and whether it could
    /// \return where to go now; nothing: the scene stays
    std::optional<Departure> answer(Answer answer, const std::function<bool()>& save) {
        std::optional<Departure> next = std::exchange(next_, std::nullopt);
        const bool go = answer == Answer::discard || (answer == Answer::save && save());
        return go ? next : std::nullopt;
    }

private:
    std::optional<Departure> next_;
};

} // namespace penumbra
