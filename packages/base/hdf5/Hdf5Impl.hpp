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

/// An open HDF5 file, for reading or for writing. Internal to this package.
struct Hdf5File::Impl {
  explicit Impl(const Comm& comm) : comm(comm.duplicate()) {}

  CommPtr comm;        ///< a duplicate: keeps HDF5's messages apart from the caller's
  std::string path;    ///< as given by the user
  hdf5::Id file = -1;  ///< on rank 0 only
  bool writing = false;

  // A file being written: rank 0 makes the datasets, every rank writes its numbers to their places in the file. Texts and attributes are
  // kept until close() writes them.
  int descriptor = -1;  ///< temporary file, on every rank
  bool checksums = false;
  std::map<std::string, std::uint64_t> sums;  ///< dataset -> sum of the checksums of this rank's values
  std::set<std::string> known{"/"};           ///< groups and datasets made, the same on all ranks
  std::set<std::string> datasets;             ///< the datasets among `known`
  std::set<std::pair<std::string, std::string>> attributes;
  std::vector<std::function<void(hdf5::Id)>> kept;  ///< on rank 0
  std::size_t keptBytes = 0;                        ///< their approximate size in the file
  unsigned long long owed = 0;                      ///< rows of this rank that were announced and not yet given

  bool isRoot() const { return comm->getRank() == 0; }
  std::string temporary() const { return path + ".part"; }
  void mustBeOpen(bool forWriting) const;
  void closeQuietly() noexcept;
  ~Impl() { closeQuietly(); }

  // Writing.

  /// Checks that a new object can be created at `at`, the same on all ranks, and records it.
  void claim(const std::string& at, bool isDataset);
  /// Keeps an action for rank 0, run after the others have closed the file.
  void keep(std::function<void(hdf5::Id)> action, std::size_t bytes);
  void addAttribute(const std::string& at, const std::string& name, std::size_t bytes, std::function<void(hdf5::Id)> write);
  /// Runs `work` on rank 0; a failing HDF5 call is the same EnvironmentError on all ranks.
  void writeOnRoot(const std::string& at, const std::function<void()>& work) const;
  EnvironmentError cannotWrite(const std::string& at, const std::string& reason) const;
  /// Makes sure that the disk holds the file as HDF5 has laid it out, and `more` bytes. On rank 0. \throws hdf5::Failed
  void reserve(unsigned long long more) const;
  /// Adds the attributes that hold the checksums. Collective.
  void keepChecksums();
  /// First row of this rank, and total number of rows. Collective.
  std::pair<unsigned long long, unsigned long long> placeOf(unsigned long long mine) const;

  // Reading.

  /// Runs `work` on rank 0; a failing HDF5 call is the same InputError on all ranks.
  void readOnRoot(const std::string& at, const std::function<void()>& work) const;
  /// Message for a missing object, with the nearest name. On rank 0.
  std::string missing(const std::string& at) const;
  template <typename T>
  std::vector<T> readNumbers(const std::string& at, bool wholeOnly) const;
  /// Checks, once, what HDF5 does not check before it reads a text of variable length. On rank 0. \throws hdf5::Failed
  void checkTexts() const;
  mutable bool textsChecked = false;
  /// True if every value of the file's type fits an int.
  bool fitsInt(const std::string& at) const;
  unsigned long long fileSize() const;  ///< bytes; the largest number if unknown
};

}  // namespace suture
