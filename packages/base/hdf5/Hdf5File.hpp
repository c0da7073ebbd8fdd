#pragma once
#include <suture/base/Types.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

class Hdf5File;

/// This rank's rows of a dataset being written, given piece by piece: the rows are never in memory as a whole. Must be destroyed before the
/// file is closed. T: double, int, GlobalId, unsigned char.
template <typename T>
class Hdf5Rows {
 public:
  Hdf5Rows(Hdf5Rows&&) noexcept;
  ~Hdf5Rows();

  /// Local. \throws EnvironmentError  if writing fails; on this rank only: call it within collectively()
  void append(const std::vector<T>& values);

 private:
  friend class Hdf5File;
  struct Impl;
  explicit Hdf5Rows(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// An HDF5 file, opened by all ranks of a communicator together; no other package includes HDF5.
///
/// A new file is written under a temporary name in the same folder and renamed by close(), so a reader never sees an incomplete file;
/// without close() (an exception) the temporary file is removed. Only rank 0 calls HDF5; the other ranks write their numbers at the offsets
/// it gives them. Disk space is reserved before anything is written there: a full disk is an error on all ranks. A file is read by rank 0
/// alone, which sends the content to the others. Paths are absolute within the file ("/VTKHDF/Points"); missing groups along a path are
/// created. A file being written cannot be read. All functions are collective over the communicator, and throw on every rank; nothing is
/// printed. Errors: EnvironmentError if the file cannot be written; InputError if it cannot be read, is not HDF5, is truncated, or lacks
/// the requested object (names file and path).
class Hdf5File {
 public:
  static Hdf5File create(const Comm& comm, const std::string& path);
  static Hdf5File open(const Comm& comm, const std::string& path);
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  ~Hdf5File();

  /// Gives every dataset of numbers written from now on a checksum, verified when the dataset is read as a whole: detects damaged files.
  void addChecksums();

  void group(const std::string& path);

  /// A dataset of `components` columns (1: a vector) whose rows are those of rank 0, then of rank 1, ...; `mine`: number of rows of this
  /// rank, all of which must be given before close().
  template <typename T>
  Hdf5Rows<T> rows(const std::string& path, GlobalId mine, int components = 1);
  /// The same, given as a whole.
  void write(const std::string& path, const std::vector<double>& values, int components = 1);
  void write(const std::string& path, const std::vector<int>& values, int components = 1);
  void write(const std::string& path, const std::vector<GlobalId>& values, int components = 1);
  void write(const std::string& path, const std::vector<unsigned char>& values, int components = 1);
  /// One text, the same on all ranks (variable length UTF-8).
  void write(const std::string& path, const std::string& text);
  /// Texts, the same on all ranks: variable length, declared as ASCII even if they are not, since VTK 9.1 reads no others.
  void write(const std::string& path, const std::vector<std::string>& texts);

  /// Attributes of an existing group or dataset; each name once.
  void attribute(const std::string& path, const std::string& name, const std::string& text);
  /// ASCII of fixed length, as VTKHDF requires for its Type.
  void fixedAttribute(const std::string& path, const std::string& name, const std::string& text);
  void attribute(const std::string& path, const std::string& name, const std::vector<GlobalId>& values);
  void attribute(const std::string& path, const std::string& name, double value);

  /// The whole dataset on every rank.
  std::vector<double> readReals(const std::string& path) const;
  std::vector<int> readInts(const std::string& path) const;
  std::vector<GlobalId> readGlobalIds(const std::string& path) const;
  /// Bytes begin .. begin + count of a dataset of bytes; count < 0: all bytes from `begin` on.
  std::string readBytes(const std::string& path, GlobalId begin = 0, GlobalId count = -1) const;
  std::string readText(const std::string& path) const;
  std::string readTextAttribute(const std::string& path, const std::string& name) const;
  bool has(const std::string& path) const;
  /// Names of the members of a group, sorted.
  std::vector<std::string> members(const std::string& path) const;

  /// Flushes and, for a file being written, renames it into place. \throws InternalError  if announced rows are missing
  void close();

  /// Disables HDF5's cleanup at program exit, which crashes if a file could not be closed because the disk was full. For programs,
  /// before any other HDF5 call. Local.
  static void withoutExitHandler();

  /// Version of the linked HDF5 library: "1.10.8". Local.
  static std::string libraryVersion();

 private:
  template <typename T>
  friend class Hdf5Rows;
  struct Impl;
  template <typename T>
  void writeAll(const std::string& path, const std::vector<T>& values, int components);
  explicit Hdf5File(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
