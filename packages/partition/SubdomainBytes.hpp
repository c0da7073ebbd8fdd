#pragma once
#include <suture/base/Buffer.hpp>
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {

/// Converts a subdomain's mesh to bytes, for a message or a file, and back. Local. \throws InternalError  too few bytes
void pack(const SubdomainMesh& part, Packer& packer);
void unpack(Unpacker& unpacker, SubdomainMesh& part);

}  // namespace suture
