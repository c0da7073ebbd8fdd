#pragma once
#include <suture/base/Types.hpp>
#include <suture/base/hdf5/Hdf5Rows.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// A new HDF5 file, written by all ranks of a communicator together.
///
/// It is written under a temporary name in the same folder and renamed by close(), so a reader never sees an incomplete file; without
/// close() (an exception) the temporary file is removed. Only rank 0 calls HDF5; the other ranks write their numbers at the offsets it
/// gives them. Disk space is reserved before anything is written there: a full disk is an error on all ranks. Paths are absolute within the
/// file ("/VTKHDF/Points"); missing groups along a path are created. All functions are collective over the communicator, and throw on every
/// rank; nothing is printed. Errors: EnvironmentError if the file cannot be written; InternalError for an object that is written twice, or
/// after close().
class Hdf5Writer {
 public:
  Hdf5Writer(const Comm& comm, const std::string& path);
  Hdf5Writer(Hdf5Writer&&) noexcept;
  Hdf5Writer& operator=(Hdf5Writer&&) noexcept;
  ~Hdf5Writer();

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

  /// Writes what is left and renames the file into place. \throws InternalError  if announced rows are missing
  void close();

 private:
  struct Impl;
  template <typename T>
  void writeAll(const std::string& path, const std::vector<T>& values, int components);
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
