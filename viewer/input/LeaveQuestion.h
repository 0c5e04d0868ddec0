// Whether a scene that was edited is left for another one.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace penumbra {

/// Edits are lost when another scene is opened: people are asked first, and may save them.
class LeaveQuestion {
public:
    enum class Answer { save, discard, cancel };

    /// Another scene is wanted. \return whether it may be opened at once: nothing would be lost
    bool ask(std::string file, bool unsaved) {
        file_ = unsaved ? std::move(file) : std::string();
        return !unsaved;
    }
    /// The scene that is wanted while the question stands; empty: there is none.
    const std::string& file() const { return file_; }

    /// \param save what saves the edits, and whether it could
    /// \return the scene to be opened now; empty: none
    std::string answer(Answer answer, const std::function<bool()>& save) {
        std::string file = std::exchange(file_, {});
        const bool go = answer == Answer::discard || (answer == Answer::save && save());
        return go ? file : std::string();
    }

private:
    std::string file_;
};

} // namespace penumbra
