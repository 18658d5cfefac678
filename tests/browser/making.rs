//! Displacements drawn, bent and imported in a real browser: control points, curves, fields, and segments from DICOM.

use super::hand::{changed, click, document, drop_files, find, focus, hear, mark, press};
use super::harness::{Session, Tab, with_browser};
use super::*;

/// Size of the page, CSS pixels: panels beside the picture, and no need to scroll them.
const TALL: (u32, u32) = (800, 760);

/// A document in a page that is at rest.
async fn opened(session: &Session, json: &str) -> Tab {
    let tab = session
        .coarse_viewer(&format!("#{}", payload(json)), TALL)
        .await;
    focus(&tab).await;
    tab.settled().await;
    tab
}

/// The picture between the panels.
async fn object(tab: &Tab, name: &str) -> image::RgbaImage {
    object_part(&tab.picture(name).await)
}

/// Drags the control of a name by so many CSS pixels, and waits until the templates are others.
async fn dragged(tab: &Tab, name: &str, by: (f64, f64)) -> serde_json::Value {
    mark(tab, "templates").await;
    let (x, y) = find(tab, name).await.middle();
    tab.drag((x, y), (x + by.0, y + by.1), 4).await;
    changed(tab, "templates").await
}

/// The document comes back whole from the page's own link.
async fn assert_link_holds(tab: &Tab) {
    let text: String = tab.eval("window.fabrica.viewer.get_link()").await;
    let back = link::decode(&text).expect("a good link");
    let back: serde_json::Value = serde_json::from_str(&back.document.to_json()).expect("JSON");
    assert_eq!(back["templates"], document(tab).await["templates"]);
}

/// A control point is dragged, and a point of a curve that follows the surface; the tissue goes along, and links hold
/// both.
#[test]
fn a_control_point_and_a_curve_are_dragged() {
    with_browser(BrowserGpu::Software, |session| async move {
        let json = r#"{"fabrica":1,"subject":{"builtin":"cube"},"templates":[{"kind":"rbf","size":[1,1,1],"params":{"points":[{"at":[0.7,1,0.7],"move":[0,0,-0.1]},{"at":[0.2,0.5,0.2]}]}}]}"#;
        let tab = opened(&session, json).await;
        let first = object(&tab, "control_point").await;
        click(&tab, "1. Points").await;
        let before = document(&tab).await;
        let templates = dragged(&tab, "Control point 1", (30.0, 20.0)).await;
        let points = "/0/params/points";
        let was = before["templates"].pointer(points).expect("points");
        let is = templates.pointer(points).expect("points");
        assert_ne!(was[0], is[0], "the point was dragged");
        assert_eq!(was[1], is[1], "and no other");
        // Without the handles over it.
        press(&tab, "Escape").await;
        tab.settled().await;
        let second = object(&tab, "control_point_dragged").await;
        let moved = difference(&first, &second, WHITE);
        assert!(moved.mean > 0.5, "the tissue went along: {moved:?}");
        assert_link_holds(&tab).await;
        tab.assert_no_complaints().await;
        tab.page.close().await.expect("the tab closes");

        let json = r#"{"fabrica":1,"subject":{"builtin":"tomato"},"templates":[{"kind":"peel","at":[0,0,0.3],"size":[0.6,0.4,0.3]}]}"#;
        let tab = opened(&session, json).await;
        click(&tab, "1. Peel").await;
        let first = object(&tab, "straight").await;
        mark(&tab, "templates").await;
        click(&tab, "Follow the surface").await;
        let templates = changed(&tab, "templates").await;
        let curve = templates[0]["curve"].clone();
        assert_eq!(curve["points"].as_array().map(Vec::len), Some(7));
        tab.settled().await;
        let second = object(&tab, "along_the_surface").await;
        assert!(difference(&first, &second, WHITE).mean > 0.5);
        let templates = dragged(&tab, "Curve point 4", (0.0, -30.0)).await;
        assert_ne!(curve["points"][3], templates[0]["curve"]["points"][3]);
        assert_eq!(curve["points"][1], templates[0]["curve"]["points"][1]);
        tab.frames(3).await;
        object(&tab, "curve_dragged").await;
        assert_link_holds(&tab).await;
        tab.assert_no_complaints().await;
    });
}

/// Displacements of nodes and a segmentation beside its series, as files dropped in the page.
#[test]
fn fields_and_segmentations_are_dropped() {
    with_browser(BrowserGpu::Software, |session| async move {
        let tab = opened(&session, PLAIN).await;
        let first = object(&tab, "no_field").await;
        let mut table = String::from("x,y,z,dx,dy,dz\n");
        for i in 0..125 {
            let at = [i % 5, i / 5 % 5, i / 25].map(|n| f64::from(n) * 40.0 - 80.0);
            let way = 0.3 * (at[0] + 80.0);
            table += &format!("{},{},{},0,{way},0\n", at[0], at[1], at[2]);
        }
        session.server.add("nodes.csv", table.into_bytes());
        mark(&tab, "templates").await;
        drop_files(&tab, &["nodes.csv"]).await;
        let templates = changed(&tab, "templates").await;
        assert_eq!(templates[0]["kind"], "field", "{templates}");
        assert!(templates[0]["params"]["sha256"].is_string(), "{templates}");
        tab.settled().await;
        let second = object(&tab, "field_dropped").await;
        let moved = difference(&first, &second, WHITE);
        assert!(moved.mean > 0.5, "it displaces: {moved:?}");
        assert_link_holds(&tab).await;
        // Two numbers for a node are no displacement: said in words, and nothing is lost.
        session
            .server
            .add("poor.csv", b"x,y,z,dx,dy,dz\n1,2,3,4,5\n".to_vec());
        drop_files(&tab, &["poor.csv"]).await;
        hear(&tab, "cannot be used").await;
        assert_eq!(document(&tab).await["templates"], templates);
        tab.page.close().await.expect("the tab closes");

        let Some(folder) = data_folder("fields_and_segmentations_are_dropped")
            .map(|data| data.join("dicom/seg_23x38x3"))
        else {
            return;
        };
        let tab = opened(&session, PLAIN).await;
        let names = [
            "IMG0001.dcm",
            "IMG0002.dcm",
            "IMG0003.dcm",
            "segmentation.dcm",
        ];
        for name in names {
            let bytes = std::fs::read(folder.join(name)).expect("a file of the series");
            session.server.add(name, bytes);
        }
        mark(&tab, "subject").await;
        drop_files(&tab, &names).await;
        changed(&tab, "subject").await;
        tab.settled().await;
        let subject = document(&tab).await["subject"].clone();
        tab.picture("segmentation_dropped").await;
        assert!(subject["sha256"].is_string(), "{subject}");
        assert!(subject["segments"]["sha256"].is_string(), "{subject}");
        click(&tab, "Panel: Tissues").await;
        find(&tab, "Show liver alone").await;
        tab.picture("segmentation_listed").await;
        tab.assert_no_complaints().await;
    });
}
