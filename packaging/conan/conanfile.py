"""gnomon::core for Conan 2: `conan create packaging/conan` in a checkout."""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

PARTS = ["SCENE", "RENDER", "TRACE", "REPORT", "CASEFILE", "TOOL", "SAMPLES"]


class GnomonConan(ConanFile):
    name = "gnomon"
    description = "Shadow maps, chosen by measurement"
    license = "MIT"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    package_type = "library"

    def set_version(self):
        header = load(self, os.path.join(self.recipe_folder, "..", "..", "include", "gnomon", "version.hpp"))
        self.version = ".".join(re.findall(r"#define GNOMON_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for part in ["CMakeLists.txt", "LICENSE", "*.md", "cmake/*", "docs/*", "include/*", "shaders/*", "src/*", "samples/*"]:
            copy(self, part, src=root, dst=self.export_sources_folder, excludes=["build/*", "out/*"])

    def requirements(self):
        self.requires("glm/[>=0.9.9 <2]", transitive_headers=True)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in PARTS:
            toolchain.cache_variables["GNOMON_" + part] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        # The package's own gnomonConfig.cmake is left to CMake users of the install tree.
        self.cpp_info.set_property("cmake_file_name", "gnomon")
        core = self.cpp_info.components["core"]
        core.set_property("cmake_target_name", "gnomon::core")
        core.set_property("pkg_config_name", "gnomon-core")
        core.libs = ["gnomon_core"]
        core.requires = ["glm::glm"]
