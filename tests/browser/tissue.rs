//! Scans and their tissues in a real browser: a bone that a link makes in a scan without labels, and label files beside
//! a scan. How an author makes such a bone is in path.rs.

use super::hand::drop_files;
use super::harness::{Session, Tab, with_browser};
use super::*;
use sha2::{Digest as _, Sha256};
use std::path::Path;

/// Size of the page, CSS pixels: the picture is drawn by a software GPU.
const SMALL: (u32, u32) = (360, 420);

/// Serves a file of the test data under a name; its hash.
fn serve(session: &Session, path: &Path, name: &str) -> String {
    let bytes = std::fs::read(path).expect("a file of the test data");
    let hash = Sha256::digest(&bytes);
    session.server.add(name, bytes);
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The picture of a tab between its bars.
async fn object(tab: &Tab, name: &str) -> image::RgbaImage {
    hand::without_messages(tab).await;
    let page = tab.picture(name).await;
    image::imageops::crop_imm(&page, 30, 90, 300, 240).to_image()
}

/// Opens a link, drops what it asks for, and takes a picture when all is there.
async fn opened(
    session: &Session,
    json: &str,
    files: &[&str],
    name: &str,
) -> (Tab, image::RgbaImage) {
    let start = std::time::Instant::now();
    let tab = session
        .coarse_viewer(&format!("#{}", payload(json)), SMALL)
        .await;
    tab.wait_until("window.fabrica.viewer.get_document() !== ''", 60)
        .await;
    drop_files(&tab, files).await;
    tab.settled().await;
    let picture = object(&tab, name).await;
    println!("{name} after {:.1} s", start.elapsed().as_secs_f32());
    tab.assert_no_complaints().await;
    (tab, picture)
}

/// Pixels whose green is between these parts of their red.
fn pixels_between(picture: &image::RgbaImage, low: f32, high: f32) -> usize {
    let is_meant = |p: &&image::Rgba<u8>| {
        let [r, g, b, _] = p.0.map(f32::from);
        b < 0.97 * r && r > 50.0 && (low..high).contains(&(g / r))
    };
    picture.pixels().filter(is_meant).count()
}

/// A bone made by its values stays where the flesh is cut away, and comes back from the link; the scalp cut away bares
/// the skull, the skull cut away the brain, from label files on a grid turned the other way.
#[test]
fn links_bring_their_tissues_when_the_files_are_dropped() {
    let Some(data) = data_folder("links_bring_their_tissues_when_the_files_are_dropped") else {
        return;
    };
    with_browser(BrowserGpu::Software, |session| async move {
        let thigh = serve(
            &session,
            &data.join("ct/thigh_femur_ct.nii.gz"),
            "thigh.nii.gz",
        );
        let bared = |align: &str| {
            format!(
                r#"{{"fabrica":1,"subject":{{"sha256":"{thigh}","features":[{{"name":"bone","from":{{"threshold":[180]}},"clean":[{{"close":2}},{{"largest":1}},{{"fill":true}}]}}]}},"templates":[{{"kind":"cut","at":[0,0.1,0],"size":[0.9,0.6,0.5]{align}}}],"camera":{{"distance":2}}}}"#
            )
        };
        let kept = bared(r#","align":{"to":"segment","keep":["bone"]}"#);
        let files = ["thigh.nii.gz"];
        let (tab, first) = opened(&session, &kept, &files, "tissue_bone").await;
        tab.eval::<bool>(&format!(
            "(location.hash = '{}', true)",
            payload(&bared(""))
        ))
        .await;
        tab.settled().await;
        let without = object(&tab, "tissue_no_bone").await;
        tab.page.close().await.expect("the tab closes");
        let (tab, again) = opened(&session, &kept, &files, "tissue_bone_again").await;
        tab.page.close().await.expect("the tab closes");
        assert!(first == again, "the same again, to the last bit");
        let cut = difference(&first, &without, WHITE);
        assert!(cut.mean > 1.0, "bone is kept: {cut:?}");

        let mri = data.join("mri");
        let scan = serve(&session, &mri.join("head_t1.nii.gz"), "head.nii.gz");
        let [skull, brain] = ["skull", "brain"].map(|name| {
            let file = format!("head_t1_{name}_label.nrrd");
            serve(&session, &mri.join(file), &format!("{name}.nrrd"))
        });
        let head = |templates: &str| {
            format!(
                r##"{{"fabrica":1,"subject":{{"sha256":"{scan}","segments":[{{"sha256":"{brain}","names":{{"1":"brain"}}}},{{"sha256":"{skull}","names":{{"1":"skull"}}}}]}},"templates":[{{"kind":"cut","at":[0,0.25,0.35],"size":[1,0.7,0.5],"align":{{"to":"segment","keep":["skull","brain"]}}}}{templates}],"look":{{"segments":{{"brain":{{"color":"#d06a78"}},"skull":{{"color":"#e9dfc6"}}}}}},"camera":{{"distance":2.2,"rotate":[0.2079,0,0,0.9781]}}}}"##
            )
        };
        let opening = r#",{"kind":"cut","at":[0.15,0.25,0.35],"size":[0.45,0.7,0.5],"align":{"to":"segment","keep":["brain"]}}"#;
        let files = ["brain.nrrd", "head.nii.gz", "skull.nrrd"];
        let (tab, bone) = opened(&session, &head(""), &files, "tissue_skull").await;
        tab.eval::<bool>(&format!(
            "(location.hash = '{}', true)",
            payload(&head(opening))
        ))
        .await;
        tab.settled().await;
        let opened_up = object(&tab, "tissue_brain").await;
        tab.assert_no_complaints().await;
        let ivory = [&bone, &opened_up].map(|picture| pixels_between(picture, 0.85, 0.99));
        let pink = [&bone, &opened_up].map(|picture| pixels_between(picture, 0.3, 0.66));
        println!("of the skull {ivory:?}, of the brain {pink:?} pixels");
        assert!(ivory[0] > 2000, "the skull is bare: {ivory:?}");
        assert!(pink[1] > pink[0] + 1000, "the brain is bare: {pink:?}");
    });
}
