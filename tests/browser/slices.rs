//! Slices beside the picture, and a series of slices as files.

use super::hand::{controls, document, drop_files, find, focus, press};
use super::harness::with_browser;
use super::*;

/// Many DICOM files dropped together become one scan; its slices are shown, and a template is placed on one of them.
#[test]
fn series_is_dropped_and_a_template_placed_on_a_slice() {
    const SIZE: (u32, u32) = (1280, 720);
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = session
            .coarse_viewer(&format!("#{}", payload(PLAIN)), SIZE)
            .await;
        focus(&tab).await;
        if let Some(folder) = data_folder("series_is_dropped_and_a_template_placed_on_a_slice")
            .map(|data| data.join("dicom/head_mr_17slices"))
        {
            let mut names = Vec::new();
            for entry in std::fs::read_dir(folder).expect("the series") {
                let path = entry.expect("a file").path();
                let name = path.file_name().expect("a name").to_string_lossy();
                session
                    .server
                    .add(&name, std::fs::read(&path).expect("a slice"));
                names.push(name.into_owned());
            }
            assert_eq!(names.len(), 17);
            drop_files(&tab, &names).await;
            tab.wait_until(
                "JSON.parse(window.fabrica.viewer.get_document()).subject?.sha256 !== undefined",
                60,
            )
            .await;
            // The series is drawn.
            let is_drawn = |page: &image::RgbaImage| drawn_pixels(&object_part(page)) > 3000;
            tab.drawn("series_dropped", is_drawn).await;
        } else {
            println!(
                "no series was dropped: FABRICA_TEST_DATA names no folder of scans; slices of a cube"
            );
        }

        press(&tab, "v").await;
        for name in ["Axial slice", "Coronal slice", "Sagittal slice"] {
            let pane = find(&tab, name).await;
            assert!(pane.size.0.min(pane.size.1) > 100.0, "{pane:?}");
        }
        tab.frames(3).await;
        tab.picture("slices_shown").await;

        // The crosshair goes to the middle of the axial slice; there the template is placed.
        press(&tab, "/").await;
        for letter in ["p", "o", "k", "e"] {
            press(&tab, letter).await;
        }
        press(&tab, "Enter").await;
        let pane = find(&tab, "Axial slice").await;
        let (x, y) = pane.corner(0.5, 0.4);
        tab.click(x, y).await;
        tab.wait_until(
            "JSON.parse(window.fabrica.viewer.get_document()).templates?.length === 1",
            20,
        )
        .await;
        tab.frames(3).await;
        let placed = document(&tab).await;
        let template = &placed["templates"][0];
        assert_eq!(template["kind"], "poke", "{placed}");
        let named = controls(&tab).await;
        let outlines = named.iter().filter(|c| c.name.contains("in the slice"));
        assert!(outlines.count() > 0, "it is outlined in slices: {named:?}");
        let picture = tab.picture("slices_placed").await;
        assert!(drawn_pixels(&object_part(&picture)) > 0);
        tab.assert_no_complaints().await;
    });
}
