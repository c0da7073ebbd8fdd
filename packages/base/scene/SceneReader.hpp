#pragma once
#include <suture/base/scene/SceneCompletion.hpp>
#include <suture/base/scene/Schema.hpp>

#include <string>
#include <vector>

namespace suture {

/// A scene (or study) file as read: its text, and the parameters with all defaults filled in, the same on all ranks.
struct SceneFile {
  std::string path;                     ///< as given
  std::string folder;                   ///< base folder of relative names in the file
  std::string text;                     ///< verbatim
  std::vector<std::string> overrides;   ///< as applied
  std::vector<std::string> notes;       ///< for the user: parameters without effect, entries that replace those of other files
  IncludedFiles included;               ///< other files that the scene was completed from
  Teuchos::RCP<Parameters> parameters;  ///< resolved; sublist names are full paths as Teuchos writes them
};

/// Reads an XML parameter file strictly: rank 0 reads, the text is broadcast, every rank parses and checks the same text. Every number must
/// be complete and finite, duplicate and unknown names are rejected, types and ranges are checked. A number written without a type
/// attribute, or an int where a double is expected, is accepted if it fits.
///
/// \param overrides  "Path/To/Parameter=value", as in --set; they are applied before the check and obey the same rules. An override may
///                   also create a user-named list.
/// \throws InputError        with all problems: path, found, expected, nearest name. The same on every rank; never hangs.
/// Collective over `comm`.
SceneFile readScene(const Comm& comm, const std::string& path, const Schema& schema, const std::vector<std::string>& overrides = {});

/// The same from a text in memory (tests, embedding programs); `path` is used in messages only. Local.
/// \param folder  base folder of relative names in the file; default: that of `path`
/// \param included  files that the scene is completed from, read before; others are read by this process
SceneFile parseScene(const std::string& text, const std::string& path, const Schema& schema, const std::vector<std::string>& overrides = {},
                     const std::optional<std::string>& folder = std::nullopt, const IncludedFiles& included = {});

/// The resolved parameters as XML (for --print-defaults and /Record). Local.
std::string toXml(const Parameters& parameters);

/// "Contact/fault above" from a sublist's Teuchos name "Suture->Contact->fault above"; with a parameter: "Contact/fault above/Side A".
std::string pathOf(const Parameters& list, const std::string& parameter = "");

/// Names of the sublists of a list, in the order of the file.
std::vector<std::string> sublistNames(const Parameters& list);

}  // namespace suture
