#pragma once
#include <Teuchos_Comm.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <suture/base/Errors.hpp>
#include "Hdf5File.hpp"
#include "Hdf5Object.hpp"

namespace suture {

/// A file of HDF5 that is open, for reading or for writing. Inside this package only.
struct Hdf5File::Impl {
  explicit Impl(const Comm& comm) : comm(comm.duplicate()) {}

  CommPtr comm;        ///< a duplicate: HDF5's messages and the caller's never meet
  std::string path;    ///< as the user knows it
  hdf5::Id file = -1;  ///< on rank 0 only
  bool writing = false;

  // A file being written: rank 0 makes datasets, every rank writes its numbers to their places in the file. Texts and attributes are kept
  // and written by close().
  int descriptor = -1;  ///< temporary file, on every rank
  bool checksums = false;
  std::map<std::string, std::uint64_t> sums;  ///< dataset -> sum of the checksums of this rank's values
  std::set<std::string> known{"/"};           ///< groups and datasets made, the same on all ranks
  std::set<std::string> datasets;             ///< datasets among the names
  std::set<std::pair<std::string, std::string>> attributes;
  std::vector<std::function<void(hdf5::Id)>> kept;  ///< on rank 0
  std::size_t keptBytes = 0;                        ///< their size in the file, about
  unsigned long long owed = 0;                      ///< rows of this rank that were promised and not yet given

  bool isRoot() const { return comm->getRank() == 0; }
  std::string temporary() const { return path + ".part"; }
  void mustBeOpen(bool forWriting) const;
  void closeQuietly() noexcept;
  ~Impl() { closeQuietly(); }

  // Writing.

  /// Checks that something new can be put at `at`, the same on all ranks, and remembers it.
  void claim(const std::string& at, bool isDataset);
  /// For rank 0, when the others have closed the file.
  void keep(std::function<void(hdf5::Id)> action, std::size_t bytes);
  void addAttribute(const std::string& at, const std::string& name, std::size_t bytes, std::function<void(hdf5::Id)> write);
  /// Runs `work` on rank 0; a failing HDF5 call is the same EnvironmentError on all ranks.
  void writeOnRoot(const std::string& at, const std::function<void()>& work) const;
  EnvironmentError cannotWrite(const std::string& at, const std::string& reason) const;
  /// Makes sure that the disk holds the file as HDF5 has laid it out, and `more` bytes. On rank 0. \throws hdf5::Failed
  void reserve(unsigned long long more) const;
  /// Adds the attributes with the checksums. Collective.
  void keepChecksums();
  /// First row of this rank, and number of rows on all. Collective.
  std::pair<unsigned long long, unsigned long long> placeOf(unsigned long long mine) const;

  // Reading.

  /// Runs `work` on rank 0; a failing HDF5 call is the same InputError on all ranks.
  void readOnRoot(const std::string& at, const std::function<void()>& work) const;
  /// Message for a missing object, with the nearest name. On rank 0.
  std::string missing(const std::string& at) const;
  template <typename T>
  std::vector<T> readNumbers(const std::string& at, bool wholeOnly) const;
  /// Checks, once, what HDF5 does not before it reads a text of variable length. On rank 0. \throws hdf5::Failed
  void checkTexts() const;
  mutable bool textsChecked = false;
  /// True if every value that the file's type can hold is an int.
  bool fitsInt(const std::string& at) const;
  unsigned long long fileSize() const;  ///< bytes; the largest number where the system does not tell
};

}  // namespace suture
