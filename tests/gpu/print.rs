//! Pictures for print: drawn in bands, written row by row, with their resolution, and whole or not there.

use crate::cli::fabrica_with;
use crate::gpu::{builtin, gpu, software, studio_of};
use crate::surfaces::brick;
use fabrica::data::Subject;
use fabrica::document::{Document, Illustration};
use fabrica::render::{
    FileInMemory, Image, MOST_PX, PictureSpec, PngRows, RenderError, Rows, Studio, Taker,
    decode_png,
};
use std::path::Path;
use std::process::{Command, Stdio};

const SIZE: [u32; 2] = [150, 131];

fn illustration(json: &str) -> Illustration {
    let document = Document::from_json(json).expect("a document");
    document.illustration().clone()
}

/// A picture without a shadow.
fn spec(size_px: [u32; 2], samples: u32) -> PictureSpec {
    PictureSpec {
        size_px,
        samples,
        has_shadow: false,
    }
}

/// Takes rows into a PNG file, and stops when so much is drawn.
struct Print {
    png: PngRows<FileInMemory>,
    file: FileInMemory,
    next: u32,
    most_rows: usize,
    stop_at: f32,
}

impl Print {
    fn new(size: [u32; 2], stop_at: f32) -> Self {
        let file = FileInMemory::default();
        Self {
            png: PngRows::new(file.clone(), size, None).expect("a header"),
            file,
            next: 0,
            most_rows: 0,
            stop_at,
        }
    }
}

impl Taker for Print {
    fn progress(&mut self, part: f32) -> Result<(), RenderError> {
        assert!((0.0..=1.0).contains(&part), "{part}");
        match part < self.stop_at {
            true => Ok(()),
            false => Err(RenderError::Stopped),
        }
    }

    fn take(&mut self, rows: Rows) -> Result<(), RenderError> {
        assert_eq!(rows.first, self.next, "from the top, none left out");
        let count = rows.rgba.len() / (4 * SIZE[0] as usize);
        self.next += count as u32;
        self.most_rows = self.most_rows.max(count);
        self.png.write(&rows.rgba)
    }
}

fn in_bands(studio: &Studio, shown: &Illustration, samples: u32, rows: u32) -> Image {
    let print = Print::new(SIZE, 2.0);
    let drawing = studio.render_rows(shown, spec(SIZE, samples), Some(rows), print);
    let print = pollster::block_on(drawing).expect("a picture");
    assert_eq!(print.next, SIZE[1], "all rows");
    assert!(print.most_rows <= rows as usize, "{}", print.most_rows);
    print.png.finish().expect("a file");
    decode_png(&print.file.take()).expect("a PNG")
}

/// Alignment, bodies, haze, meshes, styles, several samples and no background: the file of a print in bands holds the
/// picture that is drawn in one piece.
#[test]
fn bands_equal_the_whole_to_the_bit() {
    let bar = studio_of(software(), &builtin("bar", 48), true);
    let mesh = Studio::new(software(), &Subject::Mesh(brick()), true).expect("a studio");
    let camera = r#""camera":{"rotate":[0.2,0.1,0.3,0.927],"distance":2.1}"#;
    let bodies = r##""look":{"background":"none","segments":{"shell":0.3,"core":{"opacity":1,"color":"#20c030"}}}"##;
    let cases = [
        (
            &bar,
            1,
            r#""templates":[{"kind":"twist","size":[1,1,1],"params":{"angle":0.6}}]"#,
        ),
        (
            &bar,
            3,
            r#""templates":[{"kind":"peel","size":[0.8,0.6,0.8],"at":[0,0,0.2],"align":{"to":"segment","keep":["core"]}}]"#,
        ),
        (&bar, 2, bodies),
        (&bar, 2, r#""look":{"style":"ink"}"#),
        (
            &mesh,
            2,
            r#""look":{"background":"none","style":{"preset":"pencil","stipple":{},"ghost":{"by":"cut"}}},"templates":[{"kind":"split","size":[1,1.4,1.2],"at":[0,0.1,0.2]}]"#,
        ),
        (
            &mesh,
            3,
            r#""look":{"background":"none"},"templates":[{"kind":"split","size":[1,1.4,1.2],"at":[0,0.1,0.2]}]"#,
        ),
    ];
    for (studio, samples, rest) in cases {
        let shown = illustration(&format!(
            r#"{{"fabrica":1,"subject":{{"builtin":"bar"}},{camera},{rest}}}"#
        ));
        let whole = pollster::block_on(studio.render_image(&shown, SIZE, samples));
        let whole = whole.expect("a picture");
        let row = |y: u32| {
            let stride = 4 * SIZE[0] as usize;
            &whole.rgba[y as usize * stride..][..stride]
        };
        assert_ne!(row(40), row(75), "another band would be seen: {rest}");
        for rows in [1, 35, 64, MOST_PX] {
            if rows == 1 && samples > 1 {
                continue;
            }
            let bands = in_bands(studio, &shown, samples, rows);
            assert!(bands == whole, "bands of {rows} rows: {rest}");
        }
    }
}

/// Whoever takes the rows ends the drawing.
#[test]
fn drawing_stops_when_it_is_told_to() {
    let studio = studio_of(gpu(), &builtin("bar", 24), true);
    let shown = illustration(r#"{"fabrica":1}"#);
    let print = Print::new(SIZE, 0.4);
    let stopped = pollster::block_on(studio.render_rows(&shown, spec(SIZE, 2), Some(20), print));
    assert!(matches!(stopped, Err(RenderError::Stopped)), "it stops");
    let print = Print::new(SIZE, 2.0);
    let size = [10, MOST_PX + 1];
    let refused = pollster::block_on(studio.render_rows(&shown, spec(size, 1), None, print));
    let Err(RenderError::BadSize { max, .. }) = refused else {
        panic!("it is refused");
    };
    assert_eq!(max, MOST_PX);
}

/// A folder with a document about a bar of few voxels.
fn folder_with_bar() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let scan = crate::segment_files::nifti([16, 40, 16], |x, _, _| if x < 3 { 0 } else { 300 });
    std::fs::write(folder.path().join("bar.nii"), scan).expect("a scan");
    let document = r##"{"fabrica":1,"title":"Bar","subject":{"src":"bar.nii"},"look":{"transfer":[{"value":0,"opacity":0},{"value":100,"color":"#cc4433","opacity":1}],"background":"#002244"}}"##;
    std::fs::write(folder.path().join("bar.json"), document).expect("a document");
    folder
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = names.map(|name| name.to_string_lossy().into()).collect();
    names.retain(|name| !name.starts_with("bar."));
    names.sort();
    names
}

/// Pixels per metre as the file says them.
fn per_meter(png: &[u8]) -> Option<u32> {
    let at = png.windows(4).position(|name| name == b"pHYs")? + 4;
    let [x, y] = [at, at + 4].map(|at| png[at..at + 4].try_into().expect("four bytes"));
    assert_eq!((x, png[at + 8]), (y, 1), "square pixels, by the metre");
    Some(u32::from_be_bytes(x))
}

#[test]
fn prints_have_their_resolution_and_no_background_if_wished() {
    let folder = folder_with_bar();
    let draw = |more: &[&str]| {
        let args = ["render", "bar.json", "-o", "a.png", "--size", "60x44"];
        let outcome = fabrica_with(folder.path(), &[&args, more].concat(), b"").ok();
        let bytes = std::fs::read(folder.path().join("a.png")).expect("a file");
        let image = decode_png(&bytes).expect("a PNG");
        (per_meter(&bytes), image, outcome.err)
    };
    let (none, plain, _) = draw(&[]);
    assert_eq!(none, None, "nobody said it");
    assert_eq!(plain.rgba[..4], [0, 0x22, 0x44, 255], "the background");
    let (found, same, told) = draw(&["--dpi", "300"]);
    assert_eq!(found, Some(11_811));
    assert!(!told.contains("--dpi"), "{told}");
    assert!(same == plain, "the same pixels");
    for (dpi, taken) in [("0", "1"), ("-5", "1"), ("1e9", "9600")] {
        let (found, _, told) = draw(&[&format!("--dpi={dpi}")]);
        let wanted: f32 = taken.parse().expect("a number");
        assert_eq!(found, Some((wanted / 0.0254).round() as u32));
        assert!(told.contains("--dpi") && told.contains(taken), "{told}");
    }
    let (_, clear, _) = draw(&["--transparent", "--samples", "64"]);
    assert_eq!(clear.rgba[..4], [0; 4], "no background");
    let middle = 4 * (22 * 60 + 30);
    assert_eq!(clear.rgba[middle + 3], 255, "but the bar");
}

/// `--shadow` lays a soft shadow on what is behind the object: on the document's colour, or on nothing, where the
/// shadow alone is drawn. The object stays as it was.
#[test]
fn prints_have_a_shadow_if_wished() {
    let folder = folder_with_bar();
    let draw = |more: &[&str]| {
        let args = ["render", "bar.json", "-o", "a.png", "--size", "160x120"];
        fabrica_with(folder.path(), &[&args, more].concat(), b"").ok();
        let bytes = std::fs::read(folder.path().join("a.png")).expect("a file");
        decode_png(&bytes).expect("a PNG")
    };
    let plain = draw(&[]);
    let clear = draw(&["--transparent"]);
    let shaded = draw(&["--shadow"]);
    let cast = draw(&["--shadow", "--transparent"]);
    let pixels = |image: &Image| -> Vec<[u8; 4]> {
        let pixels = image.rgba.chunks_exact(4);
        pixels.map(|p| [p[0], p[1], p[2], p[3]]).collect()
    };
    let (mut dark, mut soft) = (0, 0);
    for (((plain, clear), shaded), cast) in pixels(&plain)
        .into_iter()
        .zip(pixels(&clear))
        .zip(pixels(&shaded))
        .zip(pixels(&cast))
    {
        match clear[3] {
            255 => {
                assert_eq!([shaded, cast], [clear, clear], "the object");
                assert_eq!(plain, clear);
            }
            0 => {
                assert_eq!(cast[..3], [0; 3], "a shadow has no colour");
                let is_darker = (0..3).all(|i| shaded[i] <= plain[i]);
                assert!(is_darker && shaded[3] == 255, "{shaded:?} on {plain:?}");
                dark += usize::from(cast[3] > 64);
                soft += usize::from((1..64).contains(&cast[3]));
            }
            _ => assert!(shaded[3] == 255 && cast[3] >= clear[3]),
        }
    }
    assert!(
        dark > 100 && soft > 100,
        "{dark} dark pixels, {soft} soft ones"
    );
    assert_eq!(cast.rgba[..4], [0; 4], "far from the object");
    assert_eq!(shaded.rgba[..4], plain.rgba[..4]);
}

#[test]
fn what_cannot_be_printed_is_refused_with_the_limit() {
    let folder = folder_with_bar();
    for (name, value, said) in [
        ("--size", "8193x10", "8192"),
        ("--size", "10x100000", "8192"),
        ("--size", "10x0", "8192"),
        ("--dpi", "NaN", "dots per inch"),
        ("--dpi", "inf", "dots per inch"),
        ("--dpi", "fine", "dots per inch"),
        ("--samples", "0", "1..=1024"),
        ("--samples", "1.5", "--samples"),
    ] {
        let args = ["render", "bar.json", "-o", "a.png", name, value];
        let mut command = Command::new(env!("CARGO_BIN_EXE_fabrica"));
        let output = command.args(args).current_dir(folder.path()).output();
        let output = output.expect("the program ends");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name} {value}: {told}");
        assert!(told.contains(said), "{name} {value}: {told}");
    }
    assert_eq!(files(folder.path()), [""; 0], "nothing is written");
}

/// The part of a text between two others.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    let (_, rest) = text.split_once(from).expect(from);
    rest.split_once(to).expect(to).0
}

/// An SVG file holds the picture without texts, its outlines as paths and its texts as texts.
#[test]
fn a_plate_keeps_its_lines_and_letters() {
    let folder = folder_with_bar();
    let document = r##"{"fabrica":1,"title":"Bar <1> & more","credit":"A. Author","subject":{"src":"bar.nii"},"look":{"transfer":[{"value":0,"opacity":0},{"value":100,"color":"#cc4433","opacity":1}],"background":"none","scale":true},"camera":{"distance":3},"labels":[{"at":[0.05,0.1,0.1],"text":"Left \"end\" <script>\u0007"}]}"##;
    std::fs::write(folder.path().join("bar.json"), document).expect("a document");
    let size = ["--size", "240x180", "--samples", "2"];
    let draw = |name: &str, more: &[&str]| {
        let args = [&["render", "bar.json", "-o", name], &size[..], more].concat();
        fabrica_with(folder.path(), &args, b"").ok();
        std::fs::read(folder.path().join(name)).expect("a file")
    };
    let svg = String::from_utf8(draw("plate.SVG", &["--dpi", "300"])).expect("text");
    let head = between(&svg, "<svg", ">");
    // 240 px at 300 dots per inch.
    for part in ["width=\"20.320mm\"", "height=\"15.240mm\"", "0 0 240 180"] {
        assert!(head.contains(part), "{part} in {head}");
    }
    assert_eq!(
        between(&svg, "<title>", "</title>"),
        "Bar &lt;1&gt; &amp; more"
    );
    let told = between(&svg, "<desc>", "</desc>");
    assert!(told.len() > 40, "what is seen, in words: {told}");
    let data = between(&svg, "data:image/png;base64,", "\"");
    let engine = base64::engine::general_purpose::STANDARD;
    let inside = base64::Engine::decode(&engine, data).expect("base64");
    let inside = decode_png(&inside).expect("a PNG");
    // The marks are in the plain picture, but no texts.
    let unmarked = document.replace(r#","scale":true"#, "");
    std::fs::write(folder.path().join("bar.json"), unmarked).expect("a document");
    let plain = decode_png(&draw("plain.png", &[])).expect("a PNG");
    assert!(inside == plain, "the picture without texts and marks");

    let texts: Vec<&str> = svg.split("<text ").skip(1).collect();
    let said: Vec<&str> = texts
        .iter()
        .map(|text| between(text, ">", "</text>"))
        .collect();
    assert_eq!(said[1], "Bar &lt;1&gt; &amp; more", "after the bar's");
    assert_eq!(said[2], "A. Author");
    assert_eq!(said[3..].join(""), "Left &quot;end&quot; &lt;script&gt;");
    assert!(
        !svg.contains("<script") && !svg.contains('\u{7}'),
        "{said:?}"
    );

    let outlines = between(&svg, "id=\"outlines\"", "</g>");
    let paths: Vec<&str> = outlines.split(" d=\"").skip(1).collect();
    assert!(
        paths
            .iter()
            .any(|path| between(path, "M", "\"").ends_with('z'))
    );
    let [mut low, mut high] = [[f32::MAX; 2], [f32::MIN; 2]];
    for path in paths {
        let path = path
            .split('"')
            .next()
            .expect("a path")
            .trim_end_matches('z');
        for place in path.split(['M', 'L']).skip(1) {
            for (axis, number) in place.split(' ').enumerate() {
                let number: f32 = number.parse().expect("a number");
                low[axis] = low[axis].min(number);
                high[axis] = high[axis].max(number);
            }
        }
    }
    // The outline ends where the object does: a pixel for its own width of a step, half of one for the pixels.
    let covered = (0..240 * 180).filter(|i| plain.rgba[4 * i + 3] > 127);
    let places: Vec<[f32; 2]> = covered
        .map(|i| [(i % 240) as f32, (i / 240) as f32])
        .collect();
    for axis in 0..2 {
        let of = places.iter().map(|place| place[axis]);
        let (first, last) = (of.clone().fold(f32::MAX, f32::min), of.fold(0.0, f32::max));
        assert!((low[axis] - first).abs() <= 1.5, "{low:?} {first}");
        assert!((high[axis] - last - 1.0).abs() <= 1.5, "{high:?} {last}");
    }
}

/// The outlines of a style are paths of its width and colour, and are not in the picture below.
#[test]
fn a_plate_takes_the_pen_of_its_style() {
    let folder = folder_with_bar();
    let with = |style: &str| {
        let document = format!(
            r##"{{"fabrica":1,"subject":{{"src":"bar.nii"}},"look":{{"transfer":[{{"value":0,"opacity":0}},{{"value":100,"color":"#cc4433","opacity":1}}]{style}}},"camera":{{"distance":3}}}}"##
        );
        std::fs::write(folder.path().join("bar.json"), document).expect("a document");
        let args = ["render", "bar.json", "-o", "a.svg", "--size", "200x160"];
        fabrica_with(folder.path(), &args, b"").ok();
        let svg = std::fs::read_to_string(folder.path().join("a.svg")).expect("a file");
        let data = between(&svg, "data:image/png;base64,", "\"");
        let engine = base64::engine::general_purpose::STANDARD;
        let inside = base64::Engine::decode(&engine, data).expect("base64");
        let pen = between(&svg, "id=\"outlines\"", ">").to_owned();
        (pen, decode_png(&inside).expect("a PNG"))
    };
    let (plain_pen, plain) = with("");
    assert!(
        plain_pen.contains("stroke=\"#1a1a1a\" stroke-width=\"0.32\""),
        "{plain_pen}"
    );
    let (pen, inside) = with(r##","style":{"outline":{"width":10,"color":"#c01020"}}"##);
    assert!(
        pen.contains("stroke=\"#c01020\" stroke-width=\"1.60\""),
        "{pen}"
    );
    assert!(inside == plain, "no outlines in the picture");
}

/// A print that is asked to end leaves what was there before.
#[cfg(unix)]
#[test]
fn a_stopped_print_leaves_no_file() {
    for (signal, earlier) in [("-TERM", false), ("-INT", true)] {
        let folder = folder_with_bar();
        if earlier {
            std::fs::write(folder.path().join("a.png"), "earlier").expect("a file");
        }
        let mut command = Command::new(env!("CARGO_BIN_EXE_fabrica"));
        let size = ["--size", "8192x8192", "--samples", "64"];
        command.args(["render", "bar.json", "-o", "a.png"]);
        command.args(size).current_dir(folder.path());
        command.env("XDG_RUNTIME_DIR", folder.path());
        let mut child = command.stderr(Stdio::piped()).spawn().expect("it starts");
        while !files(folder.path())
            .iter()
            .any(|name| name.contains(".part"))
        {
            let ended = child.try_wait().expect("a child");
            assert!(ended.is_none(), "it ended before: {ended:?}");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        let id = child.id().to_string();
        let sent = Command::new("kill").args([signal, &id]).status();
        assert!(sent.expect("it is sent").success());
        let output = child.wait_with_output().expect("it ends");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(told.contains("error: a.png: stopped"), "{told}");
        let left = files(folder.path());
        match earlier {
            true => {
                assert_eq!(left, ["a.png"]);
                let kept = std::fs::read(folder.path().join("a.png")).expect("a file");
                assert_eq!(kept, b"earlier");
            }
            false => assert_eq!(left, [""; 0]),
        }
    }
}
