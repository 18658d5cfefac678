//! Pictures drawn by the native program and packed into sheets of equal tiles. `cargo xtask icons` and `cargo xtask
//! examples`: those that ship with the program.
//!
//! A sheet is a PNG with a palette of 256 colours: a third of the bytes of one with all colours, and no difference that
//! an eye finds in a picture of this size.

use std::fs;
use std::path::{Path, PathBuf};

use fabrica::document::Document;
use fabrica::placed::{ICON_COLUMNS, ICON_PX, icon_document, icon_kinds};

use crate::compare::values;
use crate::examples;
use crate::gallery::{draw, native};
use crate::palette::{Rgba, palette};
use crate::run::{Outcome, report, root};

/// Where the catalogue's panel finds its icons.
const ICONS: &str = "src/app/panel/catalogue.png";
/// Samples per pixel of a tile.
const SAMPLES: u32 = 16;

/// Draws the icons of the catalogue anew.
pub(crate) fn icons(args: &[String]) -> Outcome {
    let fabrica = program_of("icons", args)?;
    let mut sheet = Sheet::new([ICON_PX; 2], ICON_COLUMNS);
    for kind in icon_kinds() {
        let document = icon_document(kind).map_err(|error| format!("{kind:?}: {error}"))?;
        sheet.add(&fabrica, &document, 0)?;
    }
    // The program that it is built into is packed as a whole: by brotli the pixels take a fifth less than by a PNG.
    sheet.write(&root().join(ICONS), png::Compression::NoCompression)
}

/// Writes the list of examples, and draws their pictures as they open.
pub(crate) fn examples(args: &[String]) -> Outcome {
    let examples = examples::examples(root())?;
    let list = root().join(examples::LIST);
    let text = examples::list(&examples);
    fs::write(&list, text).map_err(|error| format!("{}: {error}", list.display()))?;
    let fabrica = program_of("examples", args)?;
    let mut sheet = Sheet::new(examples::TILE_PX, examples::COLUMNS);
    for (_, document) in &examples {
        sheet.add(&fabrica, document, 0)?;
    }
    sheet.write(&root().join(examples::PICTURES), png::Compression::High)
}

/// The native program: that of `--program FILE`, else it is built.
pub(crate) fn program_of(command: &str, args: &[String]) -> Result<PathBuf, String> {
    match args {
        [] => native(None),
        [flag, path] if flag == "--program" => native(Some(path.as_ref())),
        _ => Err(format!("{command} takes --program FILE and nothing else")),
    }
}

/// Tiles on their way into one picture.
pub(crate) struct Sheet {
    /// Width and height of a tile, pixels.
    tile: [u32; 2],
    columns: u32,
    tiles: Vec<Vec<Rgba>>,
}

impl Sheet {
    pub(crate) fn new(tile: [u32; 2], columns: u32) -> Self {
        Self {
            tile,
            columns,
            tiles: Vec::new(),
        }
    }

    /// Draws the next tile: a document at a step.
    pub(crate) fn add(&mut self, fabrica: &Path, document: &Document, step: usize) -> Outcome {
        let folder = root().join("target/xtask");
        fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let file = folder.join("tile.png");
        draw(fabrica, document, step, &file, self.tile, SAMPLES)?;
        let bytes = fs::read(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let (_, values) = values(&bytes)?;
        let pixels = values.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]);
        self.tiles.push(pixels.collect());
        Ok(())
    }

    /// Width and height of the whole in pixels, and its pixels by rows. Places that no tile takes are clear.
    fn pixels(&self) -> ([u32; 2], Vec<Rgba>) {
        let [width, height] = self.tile.map(|side| side as usize);
        let columns = self.columns as usize;
        let rows = self.tiles.len().div_ceil(columns);
        let mut pixels = vec![[0; 4]; columns * width * rows * height];
        for (i, tile) in self.tiles.iter().enumerate() {
            let corner = (i / columns * height) * columns * width + i % columns * width;
            for (y, line) in tile.chunks_exact(width).enumerate() {
                let start = corner + y * columns * width;
                pixels[start..start + width].copy_from_slice(line);
            }
        }
        let size = [columns * width, rows * height].map(|side| side as u32);
        (size, pixels)
    }

    /// Writes it with a palette.
    fn write(&self, path: &Path, compression: png::Compression) -> Outcome {
        let (size, pixels) = self.pixels();
        self.written(path, encoded(size, &pixels, compression))
    }

    /// Writes it with all of its colours: what ships with nothing may be larger.
    pub(crate) fn write_whole(&self, path: &Path) -> Outcome {
        let ([width, height], pixels) = self.pixels();
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_compression(png::Compression::High);
        let written = encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(pixels.as_flattened()));
        self.written(path, written.map(|()| bytes))
    }

    fn written(&self, path: &Path, bytes: Result<Vec<u8>, png::EncodingError>) -> Outcome {
        let bytes = bytes.map_err(|error| format!("{}: {error}", path.display()))?;
        fs::write(path, &bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        report(&format!(
            "{}: {} tiles, {} kB",
            path.display(),
            self.tiles.len(),
            bytes.len().div_ceil(1000)
        ));
        Ok(())
    }
}

/// The pixels as a PNG with a palette.
fn encoded(
    [width, height]: [u32; 2],
    pixels: &[Rgba],
    compression: png::Compression,
) -> Result<Vec<u8>, png::EncodingError> {
    let (palette, index_of) = palette(pixels);
    let indices: Vec<u8> = pixels.iter().map(|pixel| index_of[pixel]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(compression);
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_palette(
        palette
            .iter()
            .flat_map(|c| [c[0], c[1], c[2]])
            .collect::<Vec<u8>>(),
    );
    if palette.iter().any(|color| color[3] < 255) {
        encoder.set_trns(palette.iter().map(|color| color[3]).collect::<Vec<u8>>());
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(bytes)
}
