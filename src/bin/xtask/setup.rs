//! Finds or installs what the page and the tests need. Programs that are there already are not touched.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, cargo, cargo_bin, find, output, program, report, root, run};

/// The newest that the pinned compiler builds.
const TRUNK: &str = "0.21.14";
const TARGET: &str = "wasm32-unknown-unknown";

/// The wasm target, wasm-bindgen at the version in Cargo.lock, Trunk, and the sources of all dependencies.
pub(crate) fn for_page() -> Outcome {
    wasm_target()?;
    wasm_bindgen()?;
    trunk()?;
    // Trunk builds offline, so everything has to be there before.
    run(
        "fetch the dependencies",
        cargo().args(["fetch", "--locked"]),
    )
}

/// A software GPU, a browser and a display for it.
pub(crate) fn for_tests() -> Outcome {
    if !cfg!(target_os = "linux") {
        return match chromium() {
            Some(_) => Ok(()),
            None => Err(
                "the browser tests need Chrome or Chromium: install it, or name it in CHROME"
                    .to_owned(),
            ),
        };
    }
    let mut missing = Vec::new();
    if !has_vulkan_driver() {
        missing.push("mesa-vulkan-drivers");
        missing.push("libvulkan1");
    }
    if chromium().is_none() {
        missing.push("chromium");
    }
    if find("Xvfb").is_none() {
        missing.push("xvfb");
    }
    if missing.is_empty() {
        return Ok(());
    }
    let wanted = missing.join(" ");
    let is_root = output(program("id").arg("-u")).is_some_and(|id| id.trim() == "0");
    if find("apt-get").is_none() || !is_root {
        return Err(format!(
            "the tests need a software Vulkan driver (lavapipe), Chromium and Xvfb. Missing, by Debian's names: {wanted}. \
             Install them (on Debian and Ubuntu: sudo apt-get install {wanted}) and run this again"
        ));
    }
    let mut apt = program("apt-get");
    apt.args(["install", "--yes", "--no-install-recommends"])
        .args(&missing);
    apt.env("DEBIAN_FRONTEND", "noninteractive");
    let what = format!("install {wanted}");
    if run(&what, &mut apt).is_err() {
        // The lists may be missing or old.
        run("update the package lists", program("apt-get").arg("update"))?;
        run(&what, &mut apt)?;
    }
    Ok(())
}

fn wasm_target() -> Outcome {
    let works = wasm_target_works();
    if works.is_ok() {
        return Ok(());
    }
    // The target of the very toolchain that builds here, whatever the default one is.
    let mut rustup = program("rustup");
    rustup.args(["target", "add", TARGET]);
    if find("rustup").is_some()
        && run("add the WebAssembly target with rustup", &mut rustup).is_ok()
    {
        return wasm_target_works();
    }
    report("rustup could not add the target; building std from the compiler's own source");
    wasm_std_from_source()?;
    wasm_target_works()
}

/// Compiles and links a program with std, as only that shows that the target is whole.
fn wasm_target_works() -> Outcome {
    let folder = root().join("target/xtask");
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(&folder).map_err(fail)?;
    let source = folder.join("probe.rs");
    let text = "#[unsafe(no_mangle)] pub extern \"C\" fn probe(n: u32) -> usize { (0..n).map(|i| format!(\"{i}\")).collect::<String>().len() }\n";
    std::fs::write(&source, text).map_err(fail)?;
    let mut rustc = program("rustc");
    rustc.args([
        "--edition",
        "2024",
        "--target",
        TARGET,
        "--crate-type",
        "cdylib",
        "-O",
    ]);
    rustc.args(["-C", "panic=abort", "-C", "lto=fat", "-o"]);
    rustc.arg(folder.join("probe.wasm")).arg(&source);
    match output(&mut rustc) {
        Some(_) => Ok(()),
        None => Err(format!(
            "this compiler has no working {TARGET}: run `rustup target add {TARGET}` (a pinned toolchain needs it itself), \
             or install your distribution's package for it (Debian: libstd-rust-dev-wasm32)"
        )),
    }
}

/// Builds std for the target with the source that belongs to this compiler: rustup's component `rust-src`, or a package
/// of the distribution that has exactly this release.
fn wasm_std_from_source() -> Outcome {
    let say_what = || {
        format!(
            "no source of this compiler's std was found: run `rustup component add rust-src`, or install the rust-src package \
             of exactly this release, or add the target with `rustup target add {TARGET}`"
        )
    };
    let sysroot = output(program("rustc").args(["--print", "sysroot"])).ok_or_else(say_what)?;
    let sysroot = PathBuf::from(sysroot.trim());
    let verbose = output(program("rustc").arg("-vV")).ok_or_else(say_what)?;
    let release = verbose
        .lines()
        .find_map(|line| line.strip_prefix("release: "))
        .ok_or_else(say_what)?;
    let places = [
        sysroot.join("lib/rustlib/src/rust/library"),
        PathBuf::from(format!("/usr/src/rustc-{release}/library")),
    ];
    let is_source = |place: &PathBuf| place.join("Cargo.lock").is_file();
    let mut library = places.iter().find(|place| is_source(place)).cloned();
    if library.is_none() {
        library = source_of_debian(release);
    }
    let library = library.ok_or_else(say_what)?;
    let folder = root().join("target/xtask/std");
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(folder.join("src")).map_err(fail)?;
    std::fs::write(folder.join("src/lib.rs"), "#![no_std]\n").map_err(fail)?;
    let manifest =
        "[package]\nname = \"p\"\nversion = \"0.0.0\"\nedition = \"2024\"\n[workspace]\n";
    std::fs::write(folder.join("Cargo.toml"), manifest).map_err(fail)?;
    let mut build = cargo();
    build.current_dir(&folder);
    build.args(["build", "--release", "--target", TARGET]);
    build.arg("-Zbuild-std=std,panic_abort,panic_unwind,proc_macro");
    build.env("RUSTC_BOOTSTRAP", "1");
    build.env("__CARGO_TESTS_ONLY_SRC_ROOT", &library);
    build.env("CARGO_TARGET_DIR", folder.join("target"));
    // Without bitcode, fat link-time optimisation fails.
    build.env("RUSTFLAGS", "-Cembed-bitcode=yes");
    run("build std for WebAssembly", &mut build)?;
    let to = sysroot.join("lib/rustlib").join(TARGET).join("lib");
    std::fs::create_dir_all(&to).map_err(|error| format!("{}: {error}", to.display()))?;
    let built = folder.join("target").join(TARGET).join("release/deps");
    for entry in std::fs::read_dir(&built).map_err(fail)?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.ends_with(".rlib") && !name.starts_with("libp-") {
            std::fs::copy(entry.path(), to.join(&name))
                .map_err(|error| format!("{}: {error}", to.display()))?;
        }
    }
    // Code that was built with another std cannot be linked with this one.
    let _nothing_there = std::fs::remove_dir_all(root().join("target").join(TARGET));
    Ok(())
}

/// Debian's `rust-src` of this release, unpacked under target/; apt checks its signature.
fn source_of_debian(release: &str) -> Option<PathBuf> {
    let listed = output(program("apt-cache").args(["madison", "rust-src"]))?;
    let version = listed
        .lines()
        .filter_map(|line| line.split('|').nth(1))
        .map(str::trim)
        .find(|version| version.starts_with(&format!("{release}+")))?
        .to_owned();
    let folder = root().join("target/xtask/rust-src");
    std::fs::create_dir_all(&folder).ok()?;
    let mut download = program("apt-get");
    download.current_dir(&folder);
    download.args(["download", &format!("rust-src={version}")]);
    run("fetch the source of std from Debian", &mut download).ok()?;
    let package = std::fs::read_dir(&folder)
        .ok()?
        .flatten()
        .map(|entry| entry.path())
        .find(|path| path.extension().is_some_and(|e| e == "deb"))?;
    let mut unpack = program("dpkg-deb");
    unpack.arg("-x").arg(&package).arg(&folder);
    run("unpack it", &mut unpack).ok()?;
    let library = folder.join(format!("usr/src/rustc-{release}/library"));
    library.join("Cargo.lock").is_file().then_some(library)
}

/// The version of a package in Cargo.lock.
fn locked_version(package: &str) -> Result<String, String> {
    let path = root().join("Cargo.lock");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let name = format!("name = \"{package}\"");
    let mut lines = text.lines().skip_while(|line| *line != name).skip(1);
    let version = lines
        .next()
        .and_then(|line| line.strip_prefix("version = \"")?.strip_suffix('"'));
    version
        .map(str::to_owned)
        .ok_or_else(|| format!("{}: no package {package}", path.display()))
}

fn has_version(name: &str, wanted: &str) -> bool {
    find(name)
        .and_then(|path| output(Command::new(path).arg("--version")))
        .is_some_and(|text| text.split_whitespace().nth(1) == Some(wanted))
}

fn wasm_bindgen() -> Outcome {
    let version = locked_version("wasm-bindgen")?;
    if has_version("wasm-bindgen", &version) {
        return Ok(());
    }
    // Not with --locked: its lock file names a crate version that was taken back.
    let mut install = cargo();
    install.current_dir(std::env::temp_dir());
    install.args([
        "install",
        "wasm-bindgen-cli",
        "--version",
        &version,
        "--no-default-features",
        "--force",
    ]);
    run(
        &format!("install wasm-bindgen-cli {version} (2 minutes on two cores)"),
        &mut install,
    )?;
    installed("wasm-bindgen", &version)
}

fn trunk() -> Outcome {
    if has_version("trunk", TRUNK) {
        return Ok(());
    }
    let mut install = cargo();
    install.current_dir(std::env::temp_dir());
    // A debug build takes a third of the time, and Trunk itself has little to compute.
    install.args([
        "install",
        "trunk",
        "--version",
        TRUNK,
        "--locked",
        "--debug",
        "--force",
    ]);
    run(
        &format!("install Trunk {TRUNK} (4 minutes on two cores)"),
        &mut install,
    )?;
    installed("trunk", TRUNK)
}

fn installed(name: &str, version: &str) -> Outcome {
    if has_version(name, version) {
        return Ok(());
    }
    let bin = cargo_bin().unwrap_or_default();
    Err(format!(
        "{name} {version} was installed in {}, but another one is found before it: put that folder first in PATH",
        bin.display()
    ))
}

/// The browser that the tests drive.
pub(crate) fn chromium() -> Option<PathBuf> {
    let named = std::env::var_os("CHROME").map(PathBuf::from);
    let names = [
        "chromium",
        "chromium-browser",
        "google-chrome-stable",
        "google-chrome",
    ];
    let fixed = [
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
        "C:/Program Files/Google/Chrome/Application/chrome.exe",
    ];
    named
        .or_else(|| names.iter().find_map(|name| find(name)))
        .or_else(|| fixed.iter().map(PathBuf::from).find(|path| path.is_file()))
}

/// True if the Vulkan loader has any driver to load, a software one counts.
fn has_vulkan_driver() -> bool {
    if std::env::var_os("VK_ICD_FILENAMES").is_some()
        || std::env::var_os("VK_DRIVER_FILES").is_some()
    {
        return true;
    }
    [
        "/usr/share/vulkan/icd.d",
        "/etc/vulkan/icd.d",
        "/usr/local/share/vulkan/icd.d",
    ]
    .iter()
    .any(|folder| {
        std::fs::read_dir(Path::new(folder)).is_ok_and(|mut entries| entries.next().is_some())
    })
}
