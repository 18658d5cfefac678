//! The icons that ship with the program are those that the renderer draws: a sheet that is older than the shaders, or
//! than what the facts say of an icon, fails.

use crate::gpu::{builtin, software, studio_of};
use fabrica::data::{Resources, Surface};
use fabrica::document::{Illustration, ObjectSource, ParamValue, TemplateKind};
use fabrica::placed::{ICON_COLUMNS, ICON_PX, icon_document, icon_kinds};
use fabrica::render::{Image, decode_png};
use fabrica::subjects::{FINE_RESOLUTION, tool};
use std::sync::Arc;

/// What one does about it.
const REMEDY: &str = "run `cargo xtask icons`";

/// A tile of the sheet, as a picture.
fn tile(sheet: &Image, index: u32) -> Image {
    let side = ICON_PX as usize;
    let (column, row) = (
        (index % ICON_COLUMNS) as usize,
        (index / ICON_COLUMNS) as usize,
    );
    let lines = sheet.rgba.chunks_exact(4 * sheet.size[0] as usize);
    let lines = lines.skip(row * side).take(side);
    let pixels = lines.flat_map(|line| &line[4 * column * side..4 * (column + 1) * side]);
    Image {
        size: [ICON_PX; 2],
        rgba: pixels.copied().collect(),
    }
}

/// Mean difference of the channels of two pictures of one size, premultiplied, 0 to 255.
fn difference(a: &Image, b: &Image) -> f64 {
    assert_eq!(a.size, b.size);
    let channels = |pixel: &[u8]| {
        let alpha = f64::from(pixel[3]);
        let [r, g, b] = [0, 1, 2].map(|i| f64::from(pixel[i]) * alpha / 255.0);
        [r, g, b, alpha]
    };
    let pixels = a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
    let sum: f64 = pixels
        .map(|(a, b)| {
            let pairs = channels(a).into_iter().zip(channels(b));
            pairs.map(|(a, b)| (a - b).abs()).sum::<f64>()
        })
        .sum();
    sum / a.rgba.len() as f64
}

/// The tools that an icon shows, as far as its template carves by them.
fn tools(illustration: &Illustration) -> Resources {
    let mut resources = Resources::default();
    for object in &illustration.objects {
        let ObjectSource::Builtin(name) = object.source else {
            panic!("{:?} is no tool", object.source);
        };
        let surface = Surface::new(&tool(name).expect("a tool"), None, &mut |_| true);
        let surface = surface.expect("a size").carving(&mut |_| true);
        let surface = Arc::new(surface.expect("not stopped"));
        resources.objects.push((object.source.clone(), surface));
    }
    resources
}

/// A palette of 256 colours is off by 0.2 to 0.4 of 255 in the mean; adapters of one family differ by less than 0.1.
const BOUND: f64 = 0.45;

/// The kinds whose icons change least with their main parameter.
const LEAST: [TemplateKind; 3] = [
    TemplateKind::Lens,
    TemplateKind::Retractor,
    TemplateKind::Wave,
];

#[test]
fn the_icons_are_what_the_renderer_draws() {
    let sheet = decode_png(include_bytes!("../../src/app/panel/catalogue.png"));
    let sheet = sheet.unwrap_or_else(|error| panic!("{error}: {REMEDY}"));
    let studio = studio_of(software(), &builtin("cube", FINE_RESOLUTION), true);
    let draw = |illustration: &Illustration| {
        let studio = studio.clone().with_resources(tools(illustration));
        let picture = studio.render_image(illustration, [ICON_PX; 2], 16);
        pollster::block_on(picture).expect("an icon")
    };
    let mut worst: f64 = 0.0;
    for (index, kind) in icon_kinds().enumerate() {
        let document = icon_document(kind).expect("good facts");
        let mut illustration = document.illustration().clone();
        let shipped = tile(&sheet, index as u32);
        let off = difference(&draw(&illustration), &shipped);
        worst = worst.max(off);
        assert!(off < BOUND, "{kind:?} is off by {off:.2}: {REMEDY}");

        // The negative control: with a fifth less of the main parameter it is another icon, also of those that change
        // least by that.
        if !LEAST.contains(&kind) {
            continue;
        }
        let template = &mut illustration.templates[0];
        let main = kind.spec().main_param;
        match main.map(|main| &mut template.params[main]) {
            Some(ParamValue::Number(value)) => *value *= 0.8,
            Some(ParamValue::Vector(value)) => *value *= 0.8,
            _ => template.placement.size *= 0.8,
        }
        let other = difference(&draw(&illustration), &shipped);
        println!("{kind:?}: off by {off:.3}; changed by a fifth: {other:.3}");
        assert!(
            other > BOUND,
            "{kind:?}: a change of {other:.2} is not seen"
        );
    }
    println!("off by {worst:.3} at most");
}
