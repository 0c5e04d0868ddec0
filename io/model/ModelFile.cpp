#include "io/model/ModelFile.h"

#include "base/Error.h"
#include "io/model/ModelCheck.h"
#include "io/model/ModelText.h"
#include "io/model/PrimNames.h"
#include "io/model/TrialRun.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <mutex>

namespace penumbra {

namespace {

// Assimp 5.2 is not safe against damaged files: it is tried on a copy of the process first.
constexpr unsigned kTrialSeconds = 30; // of the processor; by the clock it may take
constexpr unsigned kTrialClock = 4;    // times that, where others work beside it
constexpr std::uintmax_t kTrialBytesASecond = 1'000'000;

/// Takes down what Assimp warns of.
class Listener : public Assimp::Logger {
public:
    explicit Listener(std::vector<std::string>& warnings) : warnings_(warnings) {}
    bool attachStream(Assimp::LogStream*, unsigned int) override { return false; }
    bool detachStream(Assimp::LogStream*, unsigned int) override { return false; }

private:
    void OnDebug(const char*) override {}
    void OnVerboseDebug(const char*) override {}
    void OnInfo(const char*) override {}
    void OnWarn(const char* message) override { note(message); }
    void OnError(const char* message) override { note(message); }
    void note(const char* message) {
        if (warnings_.size() < Diagnostics::kMaxTexts) warnings_.push_back(cleanText(message));
    }

    std::vector<std::string>& warnings_;
};

/// Assimp has one logger, whoever imports: they take turns.
class Listening {
public:
    Listening() : turn_(mutex()) { // the logger is Assimp's, which deletes it
        Assimp::DefaultLogger::set(new Listener(warnings_));
    }
    ~Listening() { Assimp::DefaultLogger::set(nullptr); }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    static std::mutex& mutex() {
        static std::mutex shared;
        return shared;
    }
    std::lock_guard<std::mutex> turn_;
    std::vector<std::string> warnings_;
};

/// Opens files for Assimp, within the limit, and keeps a list of them.
class RecordedFiles : public Assimp::DefaultIOSystem {
public:
    RecordedFiles(const ModelLimits& limits, std::vector<std::filesystem::path>& files)
        : limits_(limits), files_(files) {}

    // A pipe would be waited for: Assimp opens what it asks for.
    bool Exists(const char* file) const override {
        std::error_code failed;
        return std::filesystem::is_regular_file(file, failed) && limits_.folders.hold(file);
    }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (!Exists(file)) return nullptr;
        std::error_code failed;
        if (std::filesystem::file_size(file, failed) > limits_.fileBytes && !failed) return nullptr;
        Assimp::IOStream* stream = Assimp::DefaultIOSystem::Open(file, mode);
        if (stream && std::find(files_.begin(), files_.end(), file) == files_.end())
            files_.emplace_back(file);
        return stream;
    }

private:
    ModelLimits limits_;
    std::vector<std::filesystem::path>& files_;
};

// Warnings about what is no fault of the file, or is reported by us.
bool isNoise(const std::string& warning) {
    for (const char* part : {"trying to read it nevertheless", "setting default material",
                             "Reverting to 2D", "unreferenced vertices", "mHorizontalFOV",
                             "source object for connection", "shading mode not recognized"})
        if (warning.find(part) != std::string::npos) return true;
    return false;
}

// Assimp leaves such faces out of glTF and goes on.
void checkIndices(const std::vector<std::string>& warnings, const std::string& file) {
    for (const std::string& warning : warnings)
        if (warning.find("out-of-range indices") != std::string::npos)
            throw SceneFileError({file},
                                 "faces have indices out of range (export the model again)");
}

void reportWarnings(const std::vector<std::string>& warnings, const std::string& file,
                    Diagnostics& diagnostics) {
    for (const std::string& warning : warnings)
        if (!isNoise(warning)) diagnostics.warn({file}, "Assimp: " + warning);
}

template <class Item>
void drop(Item**& items, unsigned& count) {
    for (unsigned i = 0; i < count; ++i) delete items[i];
    delete[] items;
    items = nullptr;
    count = 0;
}

// What is not used, and would be refused where names of nodes are not unique. Cameras and lights of
// glTF we read ourselves.
void dropNamed(aiScene& scene, ModelFormat format) {
    drop(scene.mAnimations, scene.mNumAnimations);
    if (format != ModelFormat::gltf) return;
    drop(scene.mCameras, scene.mNumCameras);
    drop(scene.mLights, scene.mNumLights);
}

// STL says which way each facet faces, nothing of the surface that the facets stand for.
void dropNormals(aiScene& scene) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        delete[] scene.mMeshes[m]->mNormals;
        scene.mMeshes[m]->mNormals = nullptr;
    }
}

std::string advice(const std::string& why) {
    if (why.find("could not open") != std::string::npos) return " (put it beside the model)";
    return " (export the model again)";
}

} // namespace

struct ModelFile::Reader {
    std::vector<std::filesystem::path> files;
    Assimp::Importer importer;
    std::size_t animations = 0;

    [[noreturn]] void refuse(const std::filesystem::path& file, ModelFormat format) const {
        std::string why = cleanText(importer.GetErrorString());
        if (why.starts_with("GLTF: ")) why.erase(0, 6);
        throw SceneFileError({file.string()},
                             std::string("this can't be read as ") + nameOf(format) + ": " +
                                 (why.empty() ? "it is damaged" : why) + advice(why));
    }

    // What is read is checked before Assimp works on it any further, and after.
    const aiScene* read(const std::filesystem::path& file, ModelFormat format,
                        const ModelLimits& limits) {
        importer.SetIOHandler(new RecordedFiles(limits, files)); // which it deletes
        importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
        importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
        if (!importer.ReadFile(file.string(), 0) || !importer.GetScene()) refuse(file, format);
        aiScene* scene = const_cast<aiScene*>(importer.GetScene()); // the importer's own, not const
        checkModel(*scene, file.string());
        animations = scene->mNumAnimations;
        dropNamed(*scene, format);
        if (format == ModelFormat::stl) dropNormals(*scene);
        const bool shown = scene->mNumMeshes > 0;
        // Of glTF, ModelMaterials hands on how coordinates are transformed.
        const unsigned coordinates =
            format == ModelFormat::gltf ? 0u : unsigned(aiProcess_TransformUVCoords);
        if (shown && !importer.ApplyPostProcessing(coordinates | aiProcess_ValidateDataStructure))
            refuse(file, format);
        checkModel(*importer.GetScene(), file.string());
        return importer.GetScene();
    }
};

ModelFile::ModelFile(std::filesystem::path file, ModelFormat format, const ModelLimits& limits,
                     Diagnostics& diagnostics)
    : file_(std::move(file)), format_(format), source_(file_.string(), limits.fileBytes),
      reader_(std::make_unique<Reader>()) {
    if (bytes().empty()) throw SceneFileError({file_.string()}, "the file is empty");
    if (format_ == ModelFormat::gltf) gltf_ = readGltf(file_, bytes());
    reader_->files.push_back(file_);
    checkModelText(file_, format_, bytes());
    scene_ = tryAndRead(limits, diagnostics);
    animations_ = reader_->animations;
}

const aiScene* ModelFile::tryAndRead(const ModelLimits& limits, Diagnostics& diagnostics) {
    const std::string file = file_.string();
    const std::string unreadable = std::string("this can't be read as ") + nameOf(format_) + ": ";
    const Listening listening;
    const auto trial = [&] { Reader().read(file_, format_, limits); };
    const unsigned seconds = kTrialSeconds + unsigned(bytes().size() / kTrialBytesASecond);
    if (!survivesTrial(trial, seconds, kTrialClock * seconds))
        throw SceneFileError({file},
                             unreadable + "Assimp breaks down on it (export the model again)");
    const aiScene* scene = nullptr;
    try {
        scene = reader_->read(file_, format_, limits);
    } catch (const Error&) {
        checkIndices(listening.warnings(), file);
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw SceneFileError({file}, unreadable + cleanText(error.what()));
    }
    checkIndices(listening.warnings(), file);
    reportWarnings(listening.warnings(), file, diagnostics);
    return scene;
}

ModelFile::~ModelFile() = default;

std::string_view ModelFile::bytes() const {
    const auto all = source_.bytes();
    return {reinterpret_cast<const char*>(all.data()), all.size()};
}

std::vector<std::filesystem::path> ModelFile::files() const {
    return reader_->files;
}

} // namespace penumbra
