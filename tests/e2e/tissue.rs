//! Tissues in a real browser: a link to a scan with label volumes and a feature made here, and the files dropped together.

use super::harness::{Session, Tab, test_data, with_browser};
use super::*;
use sha2::{Digest as _, Sha256};
use std::path::Path;

/// Drops files of the server's together, under names that say nothing of them but what they hold.
async fn drop_files(tab: &Tab, names: &[&str]) {
    let list = serde_json::to_string(names).expect("text");
    let dropped: bool = tab
        .eval(&format!(
            "Promise.all({list}.map(n => fetch(n).then(r => r.blob()).then(b => new File([b], n)))).then(files => {{ const d = new DataTransfer(); files.forEach(f => d.items.add(f)); document.getElementById('fabrica').dispatchEvent(new DragEvent('drop', {{dataTransfer: d, bubbles: true, cancelable: true}})); return true; }})"
        ))
        .await;
    assert!(dropped, "the event was sent");
}

fn serve(session: &Session, path: &Path, name: &str) -> String {
    let bytes = std::fs::read(path).expect("a file of the test data");
    let hash = Sha256::digest(&bytes);
    session.server.add(name, bytes);
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Opens a link, drops what it asks for, and takes a picture when all is there.
async fn opened(session: &Session, json: &str, files: &[&str], name: &str) -> image::RgbaImage {
    let tab = session
        .viewer_sized(&format!("#{}", payload(json)), PAGE)
        .await;
    tab.wait_until("window.fabrica.viewer.get_document() !== ''", 60)
        .await;
    // The built-in parts of the page have come; the scan is asked for.
    rest(&tab).await;
    drop_files(&tab, files).await;
    rest(&tab).await;
    let picture = object_part(&tab.picture(name).await);
    let shown: String = tab.eval("window.fabrica.viewer.get_document()").await;
    let shown = Document::from_json(&shown).expect("a document");
    let wanted = Document::from_json(json).expect("a document");
    assert_eq!(
        shown.get("/subject"),
        wanted.get("/subject"),
        "the files are those that the link means"
    );
    tab.assert_no_complaints().await;
    tab.page.close().await.expect("the tab closes");
    picture
}

/// The scalp cut away bares the skull, the skull cut away the brain; a scan without labels gives its bone; all from links.
#[test]
fn links_bring_their_tissues_when_the_files_are_dropped() {
    let Some(data) = test_data() else {
        println!("did not run: FABRICA_TEST_DATA names no folder of scans");
        return;
    };
    with_browser(BrowserGpu::Software, |session| async move {
        let mri = data.join("mri");
        let scan = serve(&session, &mri.join("head_t1.nii.gz"), "head.nii.gz");
        let skull = serve(
            &session,
            &mri.join("head_t1_skull_label.nrrd"),
            "skull_label.nrrd",
        );
        let brain = serve(
            &session,
            &mri.join("head_t1_brain_label.nrrd"),
            "brain_label.nrrd",
        );
        let files = ["brain_label.nrrd", "head.nii.gz", "skull_label.nrrd"];
        let head = |templates: &str| {
            format!(
                r##"{{"fabrica":1,"subject":{{"sha256":"{scan}","segments":[{{"sha256":"{skull}","names":{{"1":"skull"}}}},{{"sha256":"{brain}","names":{{"1":"brain"}}}}],"features":[{{"name":"head","color":"#e0ac8c","from":{{"threshold":[40]}},"clean":[{{"close":3}},{{"largest":1}},{{"fill":true}}]}}]}},"templates":[{{"kind":"cut","size":[2.5,2.5,2.5],"align":{{"to":"segment","keep":["head"]}}}}{templates}],"look":{{"transfer":[{{"value":0,"color":"#e9dcc0","opacity":0.9}},{{"value":512,"color":"#e8c0a8","opacity":1}}],"tint":1}},"camera":{{"distance":2.4}}}}"##
            )
        };
        let scalp = r#",{"kind":"cut","at":[0,0,0.35],"size":[0.9,0.9,0.55],"align":{"to":"segment","keep":["skull","brain"]}}"#;
        let bone = r#",{"kind":"cut","at":[0.2,0,0.35],"size":[0.5,0.9,0.55],"align":{"to":"segment","keep":["brain"]}}"#;
        let whole = opened(&session, &head(""), &files, "head_whole").await;
        let bared = opened(&session, &head(scalp), &files, "head_scalp").await;
        let opened_up = opened(
            &session,
            &head(&format!("{scalp}{bone}")),
            &files,
            "head_skull",
        )
        .await;
        assert!(drawn_pixels(&opened_up) > 3000, "something is left of it");
        assert!(
            difference(&whole, &bared, WHITE).mean > 1.0,
            "the scalp is off"
        );
        assert!(
            difference(&bared, &opened_up, WHITE).mean > 0.3,
            "the skull is off"
        );

        let chest = serve(
            &session,
            &data.join("ct/chest_ct_2mm.nii.gz"),
            "chest.nii.gz",
        );
        let peel = |align: &str| {
            format!(
                r#"{{"fabrica":1,"subject":{{"sha256":"{chest}","features":[{{"name":"bone","from":{{"threshold":[180]}},"clean":[{{"close":2}},{{"largest":1}},{{"fill":true}}]}}]}},"templates":[{{"kind":"cut","at":[0,0.2,0],"size":[0.8,0.6,0.6]{align}}}],"camera":{{"distance":2}}}}"#
            )
        };
        let kept = peel(r#","align":{"to":"segment","keep":["bone"]}"#);
        let first = opened(&session, &kept, &["chest.nii.gz"], "chest_bone").await;
        let again = opened(&session, &kept, &["chest.nii.gz"], "chest_again").await;
        assert_eq!(
            difference(&first, &again, WHITE).mean,
            0.0,
            "the same again"
        );
        let without = opened(&session, &peel(""), &["chest.nii.gz"], "chest_cut").await;
        assert!(
            difference(&first, &without, WHITE).mean > 1.0,
            "bone is kept"
        );
    });
}
