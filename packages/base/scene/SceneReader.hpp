#pragma once
#include <suture/base/scene/Schema.hpp>

#include <string>
#include <vector>

namespace suture {

/// A scene (or study) file as it was read: the text as found, and the parameters with all defaults filled in, the same on all ranks.
struct SceneFile {
  std::string path;                     ///< as given
  std::string folder;                   ///< folder that relative names in the file start from
  std::string text;                     ///< verbatim
  std::vector<std::string> overrides;   ///< applied to it
  std::vector<std::string> notes;       ///< for the user: parameters that have no effect
  Teuchos::RCP<Parameters> parameters;  ///< resolved; sublist names are full paths as Teuchos writes them
};

/// Reads an XML parameter file strictly: rank 0 reads, the text is broadcast, every rank parses and checks the same text. Every number is
/// consumed entirely and finite, duplicates and unknown names are rejected, types and ranges are checked. A number written without a
/// type attribute, or an int where a double is wanted, is taken when it fits.
///
/// \param overrides  "Path/To/Parameter=value", as in --set; they are applied before the check and obey the same rules. A user-named
///                   list may be addressed and made this way.
/// \throws InputError        with all problems: path, found, expected, nearest name. The same on every rank; never hangs.
/// Collective over `comm`.
SceneFile readScene(const Comm& comm, const std::string& path, const Schema& schema, const std::vector<std::string>& overrides = {});

/// The same from a text in memory (tests, embedding programs); `path` is used in messages only. Local.
SceneFile parseScene(const std::string& text, const std::string& path, const Schema& schema,
                     const std::vector<std::string>& overrides = {});

/// The resolved parameters as XML (for --print-defaults and /Record). Local.
std::string toXml(const Parameters& parameters);

/// "Contact/fault above" from a sublist's Teuchos name "Suture->Contact->fault above"; with a parameter: "Contact/fault above/Side A".
std::string pathOf(const Parameters& list, const std::string& parameter = "");

/// Names of the sublists of a list, in the order of the file.
std::vector<std::string> sublistNames(const Parameters& list);

}  // namespace suture
