# SPDX-License-Identifier: BSD-3-Clause
"""Spack recipe: install it as packages/suture/package.py in your repository. There is no public archive to fetch yet:
`spack dev-build suture@1.0.0` builds a checkout from its top folder.
"""
from spack.package import *


class Suture(CMakePackage):
    """Parallel finite element solver for elastic bodies in contact: 2D, axisymmetric and 3D, with or without friction."""

    license("BSD-3-Clause")

    version("1.0.0")

    variant("gmsh", default=True, description="Read .geo meshes through Gmsh (GPL)")
    variant("plots", default=True, description="Python packages for suture_plot, suture_study_plot and suture_convert")
    variant("tests", default=False, description="Build the tests")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    # Suture's headers instantiate Tpetra with these ordinals. This is the version that Suture is tested with.
    depends_on("trilinos@13.2 +mpi +tpetra +belos +amesos2 +intrepid2 +shards +sacado +kokkos gotype=long_long ~openmp")
    depends_on("eigen@3.4:")
    depends_on("suite-sparse")
    depends_on("metis@5:")
    depends_on("hdf5 +mpi")
    depends_on("openblas")
    depends_on("muparser")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("gmsh", when="+gmsh")
    with when("+plots"):
        depends_on("python@3.9:", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-h5py", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-pillow", type="run")
        depends_on("py-meshio", type="run")
        depends_on("py-netcdf4", type="run")

    def cmake_args(self):
        return [
            self.define_from_variant("SUTURE_GMSH", "gmsh"),
            self.define_from_variant("SUTURE_TESTS", "tests"),
            self.define("SUTURE_UNITY", True),
            self.define("SUTURE_PYTHON_PACKAGE", "OFF"),
        ]

    def test_two_blocks(self):
        """solve an installed scene whose pressure is known: 1e5 Pa everywhere"""
        solve = Executable(self.prefix.bin.suture_solve)
        scene = self.prefix.share.suture.input.two_blocks.join("two_blocks.xml")
        printed = solve(scene, "--output", "two_blocks_out", output=str.split, error=str.split)
        assert "largest pressure 1.00e+05 Pa" in printed and "verified" in printed
