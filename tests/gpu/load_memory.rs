//! How much memory a load takes.

#![cfg(target_os = "linux")]

use std::io::{BufWriter, Write as _};
use std::path::Path;

use crate::memory::{Measured, measure, report};
use fabrica::data::{Subject, VolumeBuilder};
use fabrica::document::Document;
use fabrica::load::{LoadReport, OneFile, ReadOptions, read_volume};
use fabrica::render::{Gpu, GpuOptions, Studio};

/// Set for the process that is measured: the file it loads.
const LOAD: &str = "FABRICA_MEASURED_LOAD";

/// Not a test of its own: what the measured process does.
#[test]
fn measured() {
    let Some(path) = std::env::var_os(LOAD) else {
        return;
    };
    report(|| {
        let mut builder = VolumeBuilder::new();
        let file = std::fs::File::open(&path).expect("it was written before");
        let len = file.metadata().expect("it is there").len();
        let name = Path::new(&path).to_string_lossy().into_owned();
        let result = read_volume(
            &mut OneFile::new(&name, file, Some(len)),
            &name,
            &ReadOptions::default(),
            &mut builder,
            &mut LoadReport::default(),
        );
        let kept = result.is_ok().then(|| builder.finish().ok()).flatten();
        kept.map_or(0, |volume| volume.grid.voxel_count() as u64)
    });
}

fn measured_load(path: &Path) -> Measured {
    measure("load_memory::measured", LOAD, path.as_os_str())
}

fn header(dims: [i16; 3], datatype: i16) -> Vec<u8> {
    let mut header = vec![0; 352];
    header[..4].copy_from_slice(&348i32.to_le_bytes());
    header[344..348].copy_from_slice(b"n+1\0");
    for (i, n) in [3, dims[0], dims[1], dims[2]].iter().enumerate() {
        header[40 + 2 * i..42 + 2 * i].copy_from_slice(&n.to_le_bytes());
    }
    header[70..72].copy_from_slice(&datatype.to_le_bytes());
    for i in 0..4 {
        header[76 + 4 * i..80 + 4 * i].copy_from_slice(&1f32.to_le_bytes());
    }
    header[108..112].copy_from_slice(&352f32.to_le_bytes());
    header
}

fn slice(z: usize, n: usize) -> Vec<u8> {
    (0..n * n)
        .flat_map(|i| ((i % n + i / n + z) as i16 - 1000).to_le_bytes())
        .collect()
}

#[test]
fn a_large_volume_is_held_once() {
    let n = 512;
    let voxel_bytes = (n * n * n * 2) as u64;
    let folder = tempfile::tempdir().expect("a folder");
    let plain = folder.path().join("large.nii");
    let packed = folder.path().join("large.nii.gz");
    let mut to_plain = BufWriter::new(std::fs::File::create(&plain).expect("a file"));
    let mut to_packed = flate2::write::GzEncoder::new(
        std::fs::File::create(&packed).expect("a file"),
        flate2::Compression::fast(),
    );
    let start = header([n as i16; 3], 4);
    to_plain.write_all(&start).expect("room");
    to_packed.write_all(&start).expect("room");
    for z in 0..n {
        let slice = slice(z, n);
        to_plain.write_all(&slice).expect("room");
        to_packed.write_all(&slice).expect("room");
    }
    to_plain.flush().expect("room");
    to_packed.finish().expect("room");
    for path in [&plain, &packed] {
        let measured = measured_load(path);
        let ratio = measured.peak as f64 / voxel_bytes as f64;
        println!(
            "{}: peak {:.1} MiB, {ratio:.2} times its voxels, {:.2} s",
            path.file_name().unwrap_or_default().to_string_lossy(),
            measured.mebibytes(),
            measured.seconds
        );
        assert_eq!(measured.result, (n * n * n) as u64, "all voxels were kept");
        assert!(ratio < 1.6, "{ratio:.2} times the voxels' bytes");
        // Negative control: the measure sees at least the voxels.
        assert!(ratio > 0.98, "{ratio:.2}: the measure is blind");
    }
    let ratio = allocated_on_gpu(&plain) as f64 / voxel_bytes as f64;
    println!("on the graphics device: {ratio:.2} times its voxels");
    assert!(ratio < 1.6, "{ratio:.2} times the voxels' bytes on the GPU");
    assert!(ratio > 0.98, "{ratio:.2}: the measure is blind");
}

/// Bytes that the graphics device holds more once a scan is uploaded and a picture of it drawn.
fn allocated_on_gpu(path: &Path) -> u64 {
    let gpu = pollster::block_on(Gpu::open(&GpuOptions::default())).expect("a Vulkan adapter");
    let allocated = || {
        let report = gpu.device.generate_allocator_report();
        report.expect("Vulkan keeps count").total_allocated_bytes
    };
    let before = allocated();
    let mut builder = VolumeBuilder::new();
    read_volume(
        &mut OneFile::new(
            "large.nii",
            std::fs::File::open(path).expect("it is there"),
            None,
        ),
        "large.nii",
        &ReadOptions::default(),
        &mut builder,
        &mut LoadReport::default(),
    )
    .expect("it was read before");
    let subject = Subject::from(builder.finish().expect("whole"));
    let studio = Studio::new(&gpu, &subject, true).expect("it fits");
    let document = Document::new();
    pollster::block_on(studio.render_image(document.illustration(), [32, 32], 1))
        .expect("a picture");
    allocated().saturating_sub(before)
}

#[test]
fn lies_and_bombs_take_no_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    let limit = |input: u64| 4 * input + 64 * 1024 * 1024;
    let mut files = Vec::new();
    for (name, dims, tail) in [
        ("lying.nii", [32767, 32767, 1], 5000),
        ("flat.nii", [32767, 32767, 7], 1 << 20),
    ] {
        let mut bytes = header(dims, 4);
        bytes.resize(bytes.len() + tail, 1);
        let path = folder.path().join(name);
        std::fs::write(&path, &bytes).expect("room");
        files.push(path);
    }
    // A bomb: 400 MB of zeros in 400 kB, in a header that asks for 2 GB in one slice, and for fewer than there are.
    for (name, dims) in [
        ("bomb.nii.gz", [32767, 32767, 1]),
        ("bomb_small.nii.gz", [10, 10, 10]),
    ] {
        let path = folder.path().join(name);
        let mut encoder = flate2::write::GzEncoder::new(
            std::fs::File::create(&path).expect("a file"),
            flate2::Compression::best(),
        );
        encoder.write_all(&header(dims, 4)).expect("room");
        let zeros = vec![0; 1 << 20];
        for _ in 0..400 {
            encoder.write_all(&zeros).expect("room");
        }
        encoder.finish().expect("room");
        files.push(path);
    }
    for path in files {
        let input = std::fs::metadata(&path).expect("there").len();
        let measured = measured_load(&path);
        println!(
            "{}: {input} bytes, peak {:.1} MiB, {:.2} s",
            path.file_name().unwrap_or_default().to_string_lossy(),
            measured.mebibytes(),
            measured.seconds
        );
        assert!(measured.peak < limit(input), "{} bytes", measured.peak);
        assert!(measured.seconds < 10.0, "it does not hang");
    }
}
