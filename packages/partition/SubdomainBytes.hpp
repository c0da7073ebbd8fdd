#pragma once
#include <suture/base/Buffer.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {

/// A subdomain's mesh as bytes, for a message or a file, and back. Local. \throws InternalError  fewer bytes than it takes
void pack(const SubdomainMesh& part, Packer& packer);
void unpack(Unpacker& unpacker, SubdomainMesh& part);

}  // namespace suture
