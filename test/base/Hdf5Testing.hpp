#pragma once
#include <support/Texts.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>

#include <cstdio>
#include <functional>
#include <string>

namespace hdf5testing {

using namespace suture;

inline CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }

/// One name per number of ranks, since ctest may run them at the same time.
inline std::string nameOf(const std::string& what) { return "hdf5file_" + what + "_" + std::to_string(world()->getSize()) + ".h5"; }

inline void removeOnRoot(const std::string& path) {
  world()->barrier();
  if (world()->getRank() == 0) std::remove(path.c_str());
}

using texts::contains;

/// Message of the InputError that `work` throws; every rank must throw the same.
inline std::string inputErrorOf(const std::function<void()>& work) {
  std::string mine;
  try {
    work();
  } catch (const InputError& error) {
    mine = error.what();
  }
  for (const std::string& other : allGather(*world(), mine)) {
    if (other != mine) return "ranks differ: " + mine + " | " + other;
  }
  return mine;
}

}  // namespace hdf5testing
