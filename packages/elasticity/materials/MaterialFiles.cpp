#include <suture/base/Numbers.hpp>
#include <suture/base/UnitSystem.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/base/scene/SceneResolver.hpp>
#include <suture/base/scene/SceneTree.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/materials/MaterialFiles.hpp>

#include <dlfcn.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "BuiltInMaterials.hpp"

namespace fs = std::filesystem;

namespace suture {

namespace {

constexpr const char *kBasedOn = "Based On", *kSource = "Source", *kFiles = "Material Files", *kUnits = "Units", *kMaterials = "Materials";
constexpr const char* kUsualUnits = "m, N, Pa";

std::string valueOf(const RawList& list, const std::string& name, const std::string& fallback = "") {
  const RawParameter* given = list.parameter(name);
  return given && given->hasValue ? given->value : fallback;
}

/// "mm, N, MPa" without blanks, to compare names.
std::string packed(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return c == ' ' || c == '\t'; }), text.end());
  return text;
}

/// Converts the numbers of a list that have a unit in its schema; texts that are no numbers stay, for the check that follows.
/// \throws InputError  for a unit that cannot be converted
void convert(RawList& list, const Schema& schema, const UnitSystem& from, const UnitSystem& to) {
  const auto inOther = [&](const std::string& text, const std::string& unit) {
    const std::optional<double> value = parseReal(text);
    return value ? realText(converted(*value, unit, from, to)) : text;
  };
  for (RawParameter& parameter : list.parameters) {
    const Schema::Parameter* known = schema.find(parameter.name);
    if (!known || known->unit.empty()) continue;
    if (known->kind == Schema::Kind::Real) {
      parameter.value = inOther(parameter.value, known->unit);
    } else if (const auto entries = parseEntries(parameter.value); known->kind == Schema::Kind::Reals && entries) {
      std::string all;
      for (const std::string& entry : *entries) all += (all.empty() ? "{" : ", ") + inOther(entry, known->unit);
      parameter.value = all + "}";
    }
  }
  for (RawList& inner : list.lists)
    if (const Schema* known = schema.findList(inner.name)) convert(inner, *known, from, to);
}

/// Adds the entries of `base` that `list` does not have.
void addMissing(RawList& list, const RawList& base) {
  for (const RawParameter& parameter : base.parameters)
    if (!list.parameter(parameter.name) && !list.list(parameter.name)) {
      list.parameters.push_back(parameter);
      list.parameters.back().isAdded = true;
    }
  for (const RawList& inner : base.lists) {
    if (list.parameter(inner.name)) continue;
    if (!list.list(inner.name)) list.lists.emplace_back().name = inner.name;
    addMissing(*list.list(inner.name), inner);
  }
}

/// Names of the values that a list gives itself: "Yield Strength, Hoek-Brown/GSI".
std::vector<std::string> ownValues(const RawList& list, const std::string& path = "") {
  std::vector<std::string> names;
  for (const RawParameter& parameter : list.parameters)
    if (parameter.name != kBasedOn && parameter.name != kSource) names.push_back(joinPath(path, parameter.name));
  for (const RawList& inner : list.lists)
    for (const std::string& name : ownValues(inner, joinPath(path, inner.name))) names.push_back(name);
  return names;
}

bool isOnlySet(const RawList& list) {
  return std::all_of(list.parameters.begin(), list.parameters.end(), [](const RawParameter& one) { return one.isSet; }) &&
         std::all_of(list.lists.begin(), list.lists.end(), isOnlySet) && (!list.parameters.empty() || !list.lists.empty());
}

/// A material file as a tree.
struct MaterialFile {
  std::string name;  ///< as the scene gives it; "" for the built-in file
  std::string path;
  RawList tree;
  std::vector<std::string> materials() const {
    std::vector<std::string> names;
    for (const RawList& one : tree.lists) names.push_back(one.name);
    return names;
  }
  std::string words() const { return name.empty() ? "the built-in materials" : "'" + name + "'"; }
};

/// The completion of one scene.
class Completion {
 public:
  Completion(RawList& scene, const std::string& folder, const SceneCompletion::Reader& read, Problems& problems,
             std::vector<std::string>& notes)
      : scene_(scene), folder_(folder), read_(read), problems_(problems), notes_(notes), schema_(materialSchema()) {}

  void run() {
    readOwnFiles();
    const RawList* own = scene_.list(kMaterials);
    std::vector<std::string> names;
    if (own)
      for (const RawList& entry : own->lists) names.push_back(entry.name);
    for (const std::string& name : names) completeEntry(name);
    if (const RawList* bodies = scene_.list("Bodies"))
      for (const RawList& body : bodies->lists) {
        addNamed(body, joinPath("Bodies", body.name));
        if (const RawList* regions = body.list("Regions"))
          for (const RawList& region : regions->lists) addNamed(region, joinPath("Bodies", body.name + "/Regions/" + region.name));
      }
  }

 private:
  /// Reads a file, with its errors.
  std::optional<MaterialFile> readFile(const std::string& name, const std::string& path) {
    const IncludedFile& file = read_(path);
    if (!file.failure.empty()) {
      problems_.add(name.empty() ? path : kFiles, (name.empty() ? "" : "'" + path + "' ") + file.failure);
      return std::nullopt;
    }
    Problems found;
    MaterialFile all{name, path, parseTree(file.text, path, found)};
    for (const Problem& one : found.list()) problems_.add(one.path == path ? path : path + ": " + one.path, one.message);
    if (!found.empty()) return std::nullopt;
    return all;
  }

  void readOwnFiles() {
    const RawParameter* given = scene_.parameter(kFiles);
    if (!given || !given->hasValue) return;
    const auto names = parseEntries(given->value);
    if (!names) return;  // an error of the parameter, found later
    for (const std::string& name : *names) {
      std::optional<MaterialFile> file = readFile(name, (fs::path(folder_) / name).string());
      if (!file) {
        isIncomplete_ = true;
        continue;
      }
      for (const MaterialFile& other : files_)
        for (const std::string& material : file->materials())
          if (other.tree.list(material))
            problems_.add(kFiles, "the material '" + material + "' is in '" + other.name + "' and in '" + name + "'");
      files_.push_back(std::move(*file));
    }
    for (std::size_t i = 0; i < files_.size(); ++i) checkFile(i);
  }

  /// Checks all entries of an own file.
  void checkFile(std::size_t place) {
    const std::string path = files_[place].path;
    Problems found;
    for (const RawParameter& parameter : files_[place].tree.parameters)
      if (parameter.name != kUnits)
        found.add(parameter.name, "no such parameter in a material file." + suggestion(parameter.name, {kUnits}));
    for (const std::string& name : files_[place].materials()) {
      const std::optional<RawList> entry = entryOf(place, name, path + ": " + name);
      Parameters scratch("file");
      if (entry) resolve(wrapped(*entry), Schema().each("material", schema_), scratch, found);
    }
    for (const Problem& one : found.list()) problems_.add(path + ": " + one.path, one.message);
    if (!found.empty()) isIncomplete_ = true;
  }

  static RawList wrapped(const RawList& entry) {
    RawList whole;
    whole.lists.push_back(entry);
    return whole;
  }

  /// Completes an entry of the scene that is based on another material. \return  false after an error
  bool completeEntry(const std::string& name) {
    RawList& entry = *scene_.list(kMaterials)->list(name);
    const bool isNew = isOnlySet(entry) && isKnown(name);
    if (!isNew && !entry.parameter(kBasedOn)) {
      if (const std::string other = fileWith(name); !other.empty())
        notes_.push_back("Materials/" + name + ": the scene's entry is used, not that of " + other);
      return true;
    }
    if (const auto done = isDone_.find(name); done != isDone_.end()) {
      if (!done->second) problems_.add("Materials/" + name + "/" + kBasedOn, "the material is based on itself");
      return done->second;
    }
    isDone_[name] = false;
    const std::string base = valueOf(entry, kBasedOn, name), path = "Materials/" + name + (isNew ? "" : "/" + std::string(kBasedOn));
    const std::vector<std::string> own = ownValues(entry);
    std::optional<RawList> from;
    if (const RawList* other = base == name ? nullptr : scene_.list(kMaterials)->list(base)) {
      if (!completeEntry(base)) return false;
      from = *other;
    } else {
      from = materialOf(base, path);
    }
    if (!from) return false;
    if (RawParameter* source = from->parameter(kSource); source && !own.empty()) source->value += "; own values: " + joinNames(own);
    addMissing(entry, *from);
    return isDone_[name] = true;
  }

  /// Adds the material that a body or a region names, unless the scene has it. \param path  of the list
  void addNamed(const RawList& list, const std::string& path) {
    const RawParameter* given = list.parameter("Material");
    if (!given || !given->hasValue) return;
    const RawList* own = scene_.list(kMaterials);
    if (own && own->list(given->value)) return;
    const std::optional<RawList> entry = materialOf(given->value, joinPath(path, "Material"));
    if (!entry) return;
    if (!own) scene_.lists.emplace_back().name = kMaterials;
    RawList& added = scene_.list(kMaterials)->lists.emplace_back();
    added.name = given->value;
    addMissing(added, *entry);
  }

  /// A material of the files in the scene's units, or nothing, with an error at `path`.
  std::optional<RawList> materialOf(const std::string& name, const std::string& path) {
    for (std::size_t place = 0; place < files_.size(); ++place)
      if (files_[place].tree.list(name)) return entryOf(place, name, path);
    const std::vector<std::string>& known = builtInMaterials();
    if (std::find(known.begin(), known.end(), name) != known.end()) {
      const MaterialFile* file = builtIn();
      if (file && file->tree.list(name)) return prepared(*file, *file->tree.list(name));
      if (file) problems_.add(file->path, "has no material '" + name + "': the file does not belong to this version");
      return std::nullopt;
    }
    if (!isIncomplete_) problems_.add(path, unknown(name));
    return std::nullopt;
  }

  /// The entry of an own file, with the values of the material that it is based on.
  std::optional<RawList> entryOf(std::size_t place, const std::string& name, const std::string& path) {
    const RawList& written = *files_[place].tree.list(name);
    std::optional<RawList> entry = prepared(files_[place], written);
    const std::string base = valueOf(written, kBasedOn);
    if (!entry || base.empty()) return entry;
    if (!inFiles_.insert(name).second) {
      problems_.add(path, "the material '" + name + "' is based on itself");
      return std::nullopt;
    }
    std::optional<RawList> from;
    if (base != name && files_[place].tree.list(base))
      from = entryOf(place, base, path);
    else if (const MaterialFile* file = builtIn(); file && file->tree.list(base))
      from = prepared(*file, *file->tree.list(base));
    else
      problems_.add(files_[place].path + ": " + name + "/" + kBasedOn, unknown(base));
    inFiles_.erase(name);
    if (!from) return std::nullopt;
    addMissing(*entry, *from);
    return entry;
  }

  /// An entry of a file in the scene's units, with its source.
  std::optional<RawList> prepared(const MaterialFile& file, RawList entry) {
    const std::string its = valueOf(file.tree, kUnits, kUsualUnits), ours = valueOf(scene_, kUnits, kUsualUnits);
    if (packed(its) != packed(ours)) {
      const std::optional<UnitSystem> from = unitsOf(its, file.path + ": " + kUnits, ""), to = unitsOf(ours, kUnits, entry.name);
      if (!from || !to) return std::nullopt;
      try {
        convert(entry, schema_, *from, *to);
      } catch (const InputError& error) {
        problems_.add(file.path + ": " + entry.name, error.problems().front().message);
        return std::nullopt;
      }
    }
    const std::string cited = valueOf(entry, kSource), origin = "(" + (file.name.empty() ? "built-in material" : "from " + file.name) + ")";
    if (!entry.parameter(kSource)) entry.parameters.push_back({kSource, "string", "", true, false, true});
    entry.parameter(kSource)->value = cited.empty() ? origin : cited + " " + origin;
    return entry;
  }

  /// Units by their names; an error is reported once. \param material  that needs them, "": none
  std::optional<UnitSystem> unitsOf(const std::string& names, const std::string& path, const std::string& material) {
    try {
      return UnitSystem::named(names);
    } catch (const InputError& error) {
      if (!failedUnits_.insert(path).second) return std::nullopt;
      const std::string why =
          material.empty() ? ""
                           : ". The material '" + material + "' from a file is converted to these units; define it in Materials otherwise";
      problems_.add(path, error.problems().front().message + why);
      return std::nullopt;
    }
  }

  const MaterialFile* builtIn() {
    if (!isBuiltInRead_) {
      builtIn_ = readFile("", builtInMaterialFile());
      isBuiltInRead_ = true;
    }
    return builtIn_ ? &*builtIn_ : nullptr;
  }

  /// Words for the file that has a material, own files first; "" if none has it.
  std::string fileWith(const std::string& name) const {
    for (const MaterialFile& file : files_)
      if (file.tree.list(name)) return file.words();
    const std::vector<std::string>& known = builtInMaterials();
    return std::find(known.begin(), known.end(), name) != known.end() ? "the built-in materials" : "";
  }
  bool isKnown(const std::string& name) const { return !fileWith(name).empty(); }

  /// Message for an unknown name, with the nearest name of all sources.
  std::string unknown(const std::string& name) const {
    std::vector<std::string> all;
    std::string where;
    const auto add = [&](const std::vector<std::string>& names, const std::string& source) {
      all.insert(all.end(), names.begin(), names.end());
      where += (where.empty() ? "" : "; ") + source + ": " + (names.empty() ? "none" : joinNames(names));
    };
    std::vector<std::string> own;
    if (const RawList* materials = scene_.list(kMaterials))
      for (const RawList& one : materials->lists) own.push_back(one.name);
    add(own, "in the scene");
    for (const MaterialFile& file : files_) add(file.materials(), "in '" + file.name + "'");
    all.insert(all.end(), builtInMaterials().begin(), builtInMaterials().end());
    const std::string nearest = nearestName(name, all);
    return "no such material '" + name + "'." + (nearest.empty() ? "" : " Did you mean '" + nearest + "'?") + " Known: " + where +
           "; built in: " + std::to_string(builtInMaterials().size()) + " (suture_schema --materials lists them)";
  }

  RawList& scene_;
  const std::string& folder_;
  const SceneCompletion::Reader& read_;
  Problems& problems_;
  std::vector<std::string>& notes_;
  Schema schema_;
  std::vector<MaterialFile> files_;
  std::optional<MaterialFile> builtIn_;
  bool isBuiltInRead_ = false;
  bool isIncomplete_ = false;           // a file has errors: unknown names may follow from them
  std::map<std::string, bool> isDone_;  // entries of the scene based on others; false: not yet, or with an error
  std::set<std::string> inFiles_, failedUnits_;
};

class MaterialFileCompletion : public SceneCompletion {
 public:
  void complete(RawList& scene, const std::string& folder, const Reader& read, Problems& problems,
                std::vector<std::string>& notes) const override {
    Completion(scene, folder, read, problems, notes).run();
  }
};

}  // namespace

std::shared_ptr<const SceneCompletion> materialFiles() { return std::make_shared<MaterialFileCompletion>(); }

void addMaterialFilesParameter(Schema& scene) {
  scene
      .texts(
          kFiles, std::vector<std::string>(),
          "Own files of materials, relative to this file, as a name or several as in {a.xml, b.xml}: a list per material as in Materials, "
          "and Units, from which values are converted to those of the scene. Materials that neither the scene nor these files define are "
          "taken from the built-in file: suture_schema --materials.")
      .orOne();
}

Schema materialFileSchema() {
  return Schema("A material file.")
      .text(kUnits, kUsualUnits, "Units of length, force and stress of the values in this file, with second and kelvin.")
      .each("<material>", materialSchema(), 1);
}

const std::vector<std::string>& builtInMaterials() {
  static const std::vector<std::string> names{SUTURE_BUILT_IN_MATERIALS};
  return names;
}

std::string builtInMaterialFile() {
  const fs::path name = fs::path("share") / "suture" / "materials.xml";
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&builtInMaterialFile), &info) == 0 || !info.dli_fname) return name.string();
  std::error_code failed;
  fs::path library = fs::canonical(info.dli_fname, failed);
  if (failed) library = info.dli_fname;
  // lib/libsuture.so, lib64/libsuture.so, lib/x86_64-linux-gnu/libsuture.so
  const fs::path prefix = library.parent_path().parent_path();
  for (const fs::path& folder : {prefix, prefix.parent_path()})
    if (fs::exists(folder / name, failed)) return (folder / name).string();
  return (prefix / name).string();
}

}  // namespace suture
