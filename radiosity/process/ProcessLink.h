// A radiosity node's worker as a process of its own.
#pragma once

#include "radiosity/process/LightingLink.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace penumbra {

struct ProcessLinkOptions {
    /// What is started as `PROGRAM radiosity NAME`; empty: this program, if it is penumbra, or the
    /// penumbra beside it or on the PATH.
    std::filesystem::path program;
    /// If given, nothing is started: called with the name that people are to start
    /// `penumbra radiosity NAME` with.
    std::function<void(const std::string& name)> byHand;
};

/// A process that shares memory with this one. Each of them may die without hurting the other, and
/// leaves nothing behind.
std::unique_ptr<LightingLink> makeProcessLink(ProcessLinkOptions options = {});

/// The program that makeProcessLink() starts. \throws Error if there is none
std::string findPenumbra();

} // namespace penumbra
