//! Builds the library from its sources, or takes one that is installed: GNOMON_LIB_DIR names the folder of libgnomon.a or
//! libgnomon.so, and GNOMON_LINK is `static` or `dylib`, the default. GNOMON_GLM_INCLUDE names the folder that holds glm/,
//! where the compiler does not look by itself.
use std::{env, fs, path::Path, path::PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the sources of the library").flatten() {
        let path = entry.path();
        if path.is_dir() {
            // For research: no call of C reaches it.
            if path.file_name() != Some("study".as_ref()) {
                sources(&path, found);
            }
        } else if path.extension() == Some("cpp".as_ref()) {
            found.push(path);
        }
    }
}

fn main() {
    for name in ["GNOMON_LIB_DIR", "GNOMON_LINK", "GNOMON_GLM_INCLUDE"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    if let Ok(folder) = env::var("GNOMON_LIB_DIR") {
        let kind = env::var("GNOMON_LINK").unwrap_or_else(|_| "dylib".into());
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-lib={kind}=gnomon");
        return;
    }
    println!("cargo:rerun-if-changed=cpp");
    let mut files = Vec::new();
    sources(Path::new("cpp/core"), &mut files);
    sources(Path::new("cpp/c"), &mut files);
    files.sort();
    let mut build = cc::Build::new();
    build.cpp(true).std("c++20").files(files).include("cpp/include").include("cpp/core").include("cpp").warnings(false);
    if let Ok(glm) = env::var("GNOMON_GLM_INCLUDE") {
        build.flag("-isystem").flag(glm);
    }
    // Without optimization plans take eight times as long, in debug builds as well. The flags are those of src/core/CMakeLists.txt:
    // with them plans have the same bits by every compiler.
    build.opt_level(3).debug(false).define("NDEBUG", None);
    for flag in [
        "-ffp-contract=off",
        "-fno-exceptions",
        "-fno-math-errno",
        "-fno-trapping-math",
        "-fno-loop-unroll-and-jam",
        "-fno-slp-vectorize",
        "-fvisibility=hidden",
    ] {
        build.flag_if_supported(flag);
    }
    build.compile("gnomon");
}
