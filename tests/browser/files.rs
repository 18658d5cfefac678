//! Files that are dropped on the page or fetched by it.

use super::*;

/// A real scan dropped on the page is drawn; reloaded, the page says which file it wants.
#[test]
fn dropped_scan_is_drawn() {
    let Some(data) = data_folder("dropped_scan_is_drawn") else {
        return;
    };
    with_browser(BrowserGpu::Software, |session| async move {
        // Named, for the page would come back to the scan of the round before.
        let head = format!("#{}", payload(r#"{"fabrica":1}"#));
        for name in ["head_ct_headsq.nii.gz", "chest_ct_2mm.nii.gz"] {
            let scan = std::fs::read(data.join("ct").join(name)).expect("a scan");
            session.server.add(name, scan);
            let tab = session.coarse_viewer(&head, PAGE).await;
            tab.wait_until("window.fabrica.viewer.get_document() !== ''", 60)
                .await;
            let before = format!("{name}_before");
            let is_drawn = |page: &image::RgbaImage| drawn_pixels(&object_part(page)) > 5000;
            let before = object_part(&tab.drawn(&before, is_drawn).await);
            drop_files(&tab, &[name]).await;
            tab.wait_until(
                "JSON.parse(window.fabrica.viewer.get_document()).subject?.sha256 !== undefined",
                180,
            )
            .await;
            tab.settled().await;
            let after = object_part(&tab.picture(name).await);
            assert!(drawn_pixels(&after) > 5000, "the scan is drawn");
            assert!(
                difference(&before, &after, WHITE).mean > 3.0,
                "it is not the head of before"
            );
            hand::kept(&tab).await;
            let hash: String = tab.eval("location.hash").await;
            assert!(!hash.contains(name), "the file's name is not in the link");
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
        }
    });
}

/// Pixels that DICOM files have packed are unpacked in the page: by JPEG 2000 and JPEG-LS the same slice as without,
/// and one by JPEG.
#[test]
fn packed_slices_are_drawn() {
    let Some(data) = data_folder("packed_slices_are_drawn") else {
        return;
    };
    with_browser(BrowserGpu::Software, |session| async move {
        let mut plain = None;
        for name in [
            "MR_small",
            "MR_small_jp2klossless",
            "MR_small_jpeg_ls_lossless",
            "SC_rgb_jpeg_dcmtk",
        ] {
            let file = format!("{name}.dcm");
            let bytes = std::fs::read(data.join("dicom/single").join(&file)).expect("a slice");
            session.server.add(&file, bytes);
            // A slice lies flat: it is seen from above.
            let link = payload(&format!(
                r#"{{"fabrica":1,"subject":{{"src":"{file}"}},"camera":{{"rotate":[-0.5,0,0,0.866]}}}}"#
            ));
            let tab = session.coarse_viewer(&format!("#{link}"), PAGE).await;
            let is_drawn = |page: &image::RgbaImage| drawn_pixels(&object_part(page)) > 1000;
            tab.drawn(name, is_drawn).await;
            tab.settled().await;
            let picture = object_part(&tab.picture(name).await);
            tab.assert_no_complaints().await;
            tab.page.close().await.expect("the tab closes");
            let Some(plain) = &plain else {
                plain = Some(picture);
                continue;
            };
            let found = difference(plain, &picture, WHITE);
            println!("{name}: {found:?} from the slice without packing");
            // JPEG 2000 is off by one stored unit in some voxels (tests/fast/load_dicom.rs).
            match name.starts_with("MR_small") {
                true => assert!(found.mean < 1.0, "{name}: {found:?}"),
                false => assert!(found.mean > 3.0, "{name} is another slice: {found:?}"),
            }
        }
    });
}

/// A document from another host waits for a tap on a message that names the host.
#[test]
fn foreign_document_waits_for_a_tap() {
    with_browser(BrowserGpu::Software, |session| async move {
        let other = session.server.beside();
        other.add(
            "lesson.json",
            br#"{"fabrica":1,"title":"far","subject":{"builtin":"cube"}}"#.to_vec(),
        );
        let tab = session
            .open(&format!("?doc={}/lesson.json", other.address()))
            .await;
        tab.wait_until("document.getElementById('agree') !== null", 60)
            .await;
        let text = tab.text().await;
        let host = other.address().replace("http://", "");
        assert!(text.contains(&host), "the host is named: {text}");
        assert!(
            other.asked().is_empty(),
            "nothing was fetched before the tap"
        );
        tab.eval::<bool>("(document.getElementById('agree').click(), true)")
            .await;
        tab.wait_for_state("started").await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).title === 'far'",
            30,
        )
        .await;
    });
}

/// A 512³ volume of 16-bit voxels loads and draws; the page's heap stays under 1.6 times its bytes over the idle
/// program.
#[test]
fn large_volume_stays_within_its_memory() {
    const SIDE: usize = 512;
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session.coarse_viewer("#", (420, 360)).await;
        tab.settled().await;
        let heap = "window.fabrica.memory.buffer.byteLength";
        let idle: f64 = tab.eval(heap).await;
        session.server.add("large.nii", large_nifti(SIDE));
        let document = r#"{"fabrica":1,"subject":{"src":"large.nii"}}"#;
        tab.eval::<bool>(&format!(
            "(window.fabrica.viewer.set_link('{document}'), true)"
        ))
        .await;
        tab.settled().await;
        let picture = tab.picture("large").await;
        assert!(drawn_pixels(&picture) > 5000, "it is drawn");
        let loaded: f64 = tab.eval(heap).await;
        let bytes = (SIDE * SIDE * SIDE * 2) as f64;
        let ratio = (loaded - idle) / bytes;
        println!(
            "512³: page heap {:.0} MB idle, {:.0} MB loaded: {ratio:.2} times the volume's {:.0} MB over idle",
            idle / 1e6,
            loaded / 1e6,
            bytes / 1e6
        );
        assert!(
            ratio < 1.6,
            "the heap grew by {ratio:.2} times the volume's bytes"
        );
        tab.assert_no_complaints().await;
    });
}

/// A ball with a core, as NIfTI-1.
fn large_nifti(side: usize) -> Vec<u8> {
    let mut file = vec![0u8; 352];
    file[..4].copy_from_slice(&348i32.to_le_bytes());
    for (i, n) in [3, side as i16, side as i16, side as i16]
        .iter()
        .enumerate()
    {
        file[40 + 2 * i..42 + 2 * i].copy_from_slice(&n.to_le_bytes());
    }
    file[70..72].copy_from_slice(&4i16.to_le_bytes());
    file[72..74].copy_from_slice(&16i16.to_le_bytes());
    for i in 0..4 {
        file[76 + 4 * i..80 + 4 * i].copy_from_slice(&1f32.to_le_bytes());
    }
    file[108..112].copy_from_slice(&352f32.to_le_bytes());
    file[344..348].copy_from_slice(b"n+1\0");
    file.reserve(side * side * side * 2);
    let middle = side as i32 / 2;
    let squares: Vec<i32> = (0..side as i32)
        .map(|i| (i - middle) * (i - middle))
        .collect();
    for z in &squares {
        for y in &squares {
            for x in &squares {
                let r2 = x + y + z;
                let value: i16 = if r2 < (middle / 3).pow(2) {
                    900
                } else if r2 < (middle * 4 / 5).pow(2) {
                    60
                } else {
                    -1000
                };
                file.extend_from_slice(&value.to_le_bytes());
            }
        }
    }
    file
}
