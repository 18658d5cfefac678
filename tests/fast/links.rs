//! Links: golden ones of every release, round trips, lengths, damage, bombs, foreign text.

use fabrica::document::{
    Document, DocumentError, Edit, History, MAX_BYTES, ParamValue, TemplateKind,
};
use fabrica::link::{self, LinkError};
use serde_json::{Map, Value, json};
use std::path::Path;
use std::time::{Duration, Instant};

/// Small, fast and the same everywhere (xorshift64*).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() >> 33) as usize % n
    }

    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn rounded(&mut self, low: f64, high: f64) -> f64 {
        (self.between(low, high) * 1e4).round() / 1e4
    }

    fn rotation(&mut self) -> Value {
        let q: [f64; 4] = std::array::from_fn(|_| self.between(-1.0, 1.0));
        let length = q.iter().map(|v| v * v).sum::<f64>().sqrt().max(1e-3);
        json!(q.map(|v| (v / length * 1e4).round() / 1e4))
    }

    fn vector(&mut self, low: f64, high: f64) -> Value {
        json!([
            self.rounded(low, high),
            self.rounded(low, high),
            self.rounded(low, high)
        ])
    }

    fn text(&mut self) -> String {
        let n = self.below(24);
        (0..n)
            .map(|_| match self.below(8) {
                0 => char::from_u32(self.below(0x11_0000) as u32).unwrap_or('\u{fffd}'),
                1 => ['"', '\\', '\n', '\u{0}', '/', '~', '🧠', 'é', '}', ']'][self.below(10)],
                _ => char::from(b' ' + self.below(95) as u8),
            })
            .collect()
    }

    /// A random JSON value, nested at most `depth` deep.
    fn value(&mut self, depth: usize) -> Value {
        match self.below(if depth == 0 { 5 } else { 7 }) {
            0 => Value::Null,
            1 => json!(self.below(2) == 0),
            2 => json!(f64::from_bits(self.bits())),
            3 => json!(self.bits()),
            4 => json!(self.text()),
            5 => (0..self.below(5)).map(|_| self.value(depth - 1)).collect(),
            _ => Value::Object(
                (0..self.below(5))
                    .map(|_| (self.text(), self.value(depth - 1)))
                    .collect(),
            ),
        }
    }

    /// A document with everything in it but meshes, objects and bodies, known and unknown.
    fn document(&mut self) -> Value {
        let templates: Vec<Value> = (0..self.below(9))
            .map(|_| {
                // As many as there were when a golden link was made of such a document.
                let kind = TemplateKind::FORMULAS[self.below(18)];
                let mut params = Map::new();
                for spec in kind.spec().params {
                    if let (ParamValue::Number(_), 0..2) = (spec.kind.default_value(), self.below(3)) {
                        params.insert(spec.name.to_owned(), json!(self.rounded(-3.0, 3.0)));
                    }
                }
                let mut template = json!({
                    "kind": if self.below(9) == 0 { self.text() } else { kind.spec().name.to_owned() },
                    "at": self.vector(-0.5, 0.5), "rotate": self.rotation(), "size": self.vector(0.1, 1.0), "params": params,
                });
                if self.below(3) == 0 {
                    template["name"] = json!(self.text());
                    template["enabled"] = json!(self.below(2) == 0);
                    template["mode"] = json!(["compose", "add", "later"][self.below(3)]);
                    template["align"] = json!({ "to": "segment", "keep": ["bone", 3], "thickness": self.unit() });
                }
                template
            })
            .collect();
        let mut document = json!({
            "fabrica": 1, "title": self.text(), "templates": templates,
            "camera": { "rotate": self.rotation(), "distance": self.between(0.5, 5.0) },
            "look": { "window": [self.between(-1000.0, 0.0), self.between(1.0, 1000.0)], "opacity": "mass" },
            "labels": (0..self.below(6)).map(|_| json!({ "at": self.vector(-0.5, 0.5), "text": self.text() })).collect::<Vec<_>>(),
        });
        if !templates.is_empty() {
            document["steps"] = (0..self.below(4))
                .map(|_| json!({ "title": self.text(), "set": { "/templates/0/at": self.vector(-0.5, 0.5), "/x y": self.value(2) } }))
                .collect();
        }
        for _ in 0..self.below(3) {
            document[format!("x-{}", self.text())] = self.value(4);
        }
        document
    }

    /// A document with everything in it, known and unknown.
    fn whole_document(&mut self) -> Value {
        let mut document = self.document();
        self.surfaces(&mut document);
        document
    }

    /// A file as documents name it, with the ways in which a mesh can be read.
    fn mesh(&mut self) -> Value {
        let mut mesh = match self.below(2) {
            0 => json!({ "src": self.text() }),
            _ => json!({ "sha256": "0123456789abcdef".repeat(4) }),
        };
        let keys = [
            ("name", json!(self.text())),
            (
                "units",
                json!(["mm", "cm", "m", "in", "ell"][self.below(5)]),
            ),
            ("axes", json!(["ras", "lps", "y-up", "z-up"][self.below(4)])),
            ("smooth", json!(self.rounded(-10.0, 200.0))),
        ];
        for (key, value) in keys {
            if self.below(3) == 0 {
                mesh[key] = value;
            }
        }
        mesh
    }

    fn color(&mut self) -> Value {
        json!(format!("#{:06x}", self.below(1 << 24)))
    }

    /// What a body is made of.
    fn body(&mut self) -> Value {
        let layers: Vec<Value> = (0..self.below(9))
            .map(|_| json!({ "depth": self.rounded(-0.1, 1.2), "name": self.text(), "color": self.color(), "grain": self.unit() }))
            .collect();
        let body = ["auto", "hollow", "thick", "solid", "later"][self.below(5)];
        json!({
            "body": body, "thickness": self.rounded(0.0, 0.6),
            "inside": self.color(), "layers": layers, "gloss": self.rounded(0.0, 1.1),
        })
    }

    /// Meshes, objects and bodies, in some documents.
    fn surfaces(&mut self, document: &mut Value) {
        if self.below(2) == 0 {
            let meshes = (0..self.below(5)).map(|_| {
                let mut mesh = self.mesh();
                mesh["parts"] = json!(["named", "pieces", "whole"][self.below(3)]);
                mesh
            });
            document["subject"] = json!({ "meshes": meshes.collect::<Vec<_>>() });
            match self.below(3) {
                0 => document["subject"]["builtin"] = json!(["head", "cube"][self.below(2)]),
                1 => document["subject"]["box"] = json!([-1, -2, -3, self.unit(), 4, 5.5]),
                _ => {}
            }
        }
        for _ in 0..self.below(4) {
            let mut object = match self.below(2) {
                0 => self.mesh(),
                _ => {
                    let tools = ["scalpel", "forceps", "retractor", "needle", "saw"];
                    json!({ "builtin": tools[self.below(5)] })
                }
            };
            let keys = [
                ("at", self.vector(-0.5, 0.5)),
                ("rotate", self.rotation()),
                ("size", json!(self.rounded(0.0, 11.0))),
                ("color", self.color()),
                ("inside", self.color()),
                ("opacity", json!(self.rounded(-0.2, 1.2))),
                ("gloss", json!([0.5, 0.1][self.below(2)])),
                ("enabled", json!(self.below(2) == 0)),
                ("group", json!(self.text())),
            ];
            for (key, value) in keys {
                if self.below(2) == 0 {
                    object[key] = value;
                }
            }
            match &mut document["objects"] {
                Value::Array(objects) => objects.push(object),
                none => *none = json!([object]),
            }
        }
        if self.below(2) == 0 {
            let body = self.body();
            for (key, value) in body.as_object().into_iter().flatten() {
                document["look"][key] = value.clone();
            }
            let mut own = self.body();
            own["opacity"] = json!(self.unit());
            document["look"]["segments"] = json!({ "talus": own, "skin": 0.5 });
        }
        if document["objects"].is_array() {
            let set = json!({ "/objects/0/at": self.vector(-0.5, 0.5), "/look/thickness": 0.2, "/objects/0/opacity": self.unit() });
            let step = json!({ "title": self.text(), "set": set });
            match &mut document["steps"] {
                Value::Array(steps) => steps.push(step),
                none => *none = json!([step]),
            }
        }
    }
}

fn document(value: Value) -> Document {
    let text = value.to_string();
    Document::from_value(value).unwrap_or_else(|error| panic!("{error} in {text}"))
}

#[test]
fn any_document_survives() {
    let mut random = Random(0x5eed);
    let mut seen = [0; 3];
    for i in 0..150 {
        let document = document(random.whole_document());
        let shown = document.illustration();
        let has = [
            !shown.meshes().is_empty(),
            !shown.objects.is_empty(),
            !shown.look.surface.layers.is_empty(),
        ];
        seen.iter_mut()
            .zip(has)
            .for_each(|(n, has)| *n += i32::from(has));
        let payload = link::encode(&document);
        assert!(
            payload
                .bytes()
                .all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_'),
            "the alphabet of {payload}"
        );
        let read = link::decode(&format!("#{payload}"))
            .unwrap_or_else(|error| panic!("{i}: {error}"))
            .document;
        assert_eq!(read, document, "document {i} by link");
        assert_eq!(
            read.notices(),
            document.notices(),
            "notices of document {i}"
        );
        assert_eq!(link::encode(&read), payload, "one document has one payload");
        for text in [document.to_json(), document.to_json_compact()] {
            let read = Document::from_json(&text).expect("a document's own text");
            assert_eq!(read, document, "document {i} by text");
            assert_eq!(
                read.to_json(),
                document.to_json(),
                "one document has one text"
            );
        }
    }
    assert!(
        seen.iter().all(|n| *n > 20),
        "meshes, objects, layers: {seen:?}"
    );
}

/// The keys of recorded steps are carried, and cost nothing where they are not used.
#[test]
fn recorded_steps_are_carried() {
    let with = document(
        json!({ "fabrica": 1, "labels": [{ "text": "a", "enabled": false }],
        "steps": [{ "title": "s", "notes": "Ask first.", "hold": 7.5, "set": { "/labels/0/enabled": true } }] }),
    );
    let read = link::decode(&link::encode(&with)).expect("a link").document;
    assert_eq!(read, with);
    assert_eq!(read.illustration().steps[0].notes, "Ask first.");
    let at_default = document(
        json!({ "fabrica": 1, "labels": [{ "text": "a", "enabled": true }],
        "steps": [{ "title": "s", "notes": "", "hold": 4, "seconds": 1 }] }),
    );
    let without =
        document(json!({ "fabrica": 1, "labels": [{ "text": "a" }], "steps": [{ "title": "s" }] }));
    assert_eq!(link::encode(&at_default), link::encode(&without));
}

#[test]
fn order_of_keys_and_written_defaults_make_no_difference() {
    let a = r#"{"templates":[{"params":{"progress":0.50,"depth":0.2},"kind":"peel","rotate":[0,0,0,1.0],"at":[0,0,0]}],"title":"","fabrica":1.0,"camera":{}}"#;
    let b = r#"{"fabrica":1,"templates":[{"kind":"peel","params":{"depth":2e-1}}]}"#;
    let (a, b) = (
        Document::from_json(a).expect("a"),
        Document::from_json(b).expect("b"),
    );
    assert_eq!(link::encode(&a), link::encode(&b));
    assert_eq!(
        a.to_json_compact(),
        r#"{"fabrica":1,"templates":[{"kind":"peel","params":{"depth":0.2}}]}"#
    );
}

const KINDS: [(&str, &[&str]); 8] = [
    ("peel", &["progress", "depth"]),
    ("retractor", &["amount", "length"]),
    ("flap", &["angle", "depth"]),
    ("hole", &["amount", "taper"]),
    ("twist", &["angle", "falloff"]),
    ("cutquad", &["amount", "ripple"]),
    ("slices", &["gap", "progress"]),
    ("bend", &["angle", "start"]),
];

const CAPTIONS: [(&str, &str); 6] = [
    (
        "Incision",
        "First the scalp is incised in a wide arc behind the hairline and the galea is exposed.",
    ),
    (
        "Haemostasis",
        "Raney clips stop the bleeding at the edges while the flap is turned towards the face.",
    ),
    (
        "Bone",
        "Four burr holes are drilled and joined by the craniotome, and the bone flap is lifted off.",
    ),
    (
        "Dura",
        "The dura is opened in a star shape; its leaves are tacked to the edge of the wound.",
    ),
    (
        "Fissure",
        "The Sylvian fissure is split under the microscope to reach the middle cerebral artery.",
    ),
    (
        "Closure",
        "Finally everything is put back: the plate is fixed with titanium screws, the skin is sutured.",
    ),
];

const LABELS: [&str; 12] = [
    "Galea aponeurotica",
    "Temporalis muscle",
    "Pericranium",
    "Coronal suture",
    "Burr hole",
    "Dura mater",
    "Middle meningeal artery",
    "Superior temporal gyrus",
    "Sylvian fissure",
    "Frontal sinus",
    "Supraorbital nerve",
    "Pterion",
];

fn lesson(random: &mut Random) -> Value {
    json!({
        "fabrica": 1, "title": "Pterional craniotomy",
        "caption": "The classic approach to the anterior circulation, shown in six steps for students of the third year.",
        "templates": KINDS.iter().map(|(kind, params)| json!({
            "kind": kind, "at": random.vector(-0.4, 0.4), "rotate": random.rotation(), "size": random.vector(0.1, 0.6),
            "params": params.iter().map(|p| ((*p).to_owned(), json!(random.rounded(0.1, 0.9)))).collect::<Map<_, _>>(),
        })).collect::<Vec<_>>(),
        "look": { "transfer": "ct-soft-tissue", "window": [-160, 420] },
        "camera": { "target": random.vector(-0.1, 0.1), "rotate": random.rotation(), "distance": 1.95 },
        "labels": LABELS.map(|text| json!({ "at": random.vector(-0.4, 0.4), "text": text })),
        "steps": CAPTIONS.iter().enumerate().map(|(i, (title, caption))| {
            let pointer = format!("/templates/{i}/params/{}", KINDS[i].1[0]);
            json!({ "title": title, "caption": caption, "seconds": 1.5,
                "set": { pointer: random.rounded(0.0, 0.4), "/camera/rotate": random.rotation(), "/camera/distance": random.rounded(1.0, 3.0) } })
        }).collect::<Vec<_>>(),
    })
}

#[test]
fn links_are_short() {
    let mut random = Random(11);
    let mut longest = [0, 0];
    for _ in 0..20 {
        let peel = document(json!({
            "fabrica": 1, "subject": { "builtin": "torso" },
            "templates": [{ "kind": "peel", "at": random.vector(-0.4, 0.4), "rotate": random.rotation(), "size": random.vector(0.1, 0.6),
                "params": { "progress": random.rounded(0.0, 1.0), "depth": random.rounded(0.1, 1.0), "radius": random.rounded(0.1, 1.0), "angle": random.rounded(0.0, 6.0) } }],
            "camera": { "target": random.vector(-0.1, 0.1), "rotate": random.rotation(), "distance": random.rounded(1.0, 3.0), "fov": 35 },
            "look": { "transfer": "ct-bone", "window": [-160, 420] },
        }));
        longest[0] = longest[0].max(link::encode(&peel).len());
        longest[1] = longest[1].max(link::encode(&document(lesson(&mut random))).len());
    }
    println!(
        "one peel with everything else set: {} characters; the lesson: {}",
        longest[0], longest[1]
    );
    let bare = document(
        json!({ "fabrica": 1, "subject": { "builtin": "bar" }, "templates": [{ "kind": "peel" }] }),
    );
    println!(
        "a peel at its defaults: {} characters",
        link::encode(&bare).len()
    );
    assert!(longest[0] < 200, "one peel takes {} characters", longest[0]);
    assert!(
        longest[1] < 1800,
        "the lesson takes {} characters",
        longest[1]
    );
    assert!(link::encode(&bare).len() < 24, "the smallest peel");
}

#[test]
fn damage_is_always_noticed() {
    let mut random = Random(99);
    let links: Vec<(Document, String)> = [
        json!({ "fabrica": 1 }),
        random.whole_document(),
        lesson(&mut random),
    ]
    .map(|value| {
        let document = document(value);
        let payload = link::encode(&document);
        (document, payload)
    })
    .into();
    let mut errors = 0;
    for round in 0..10_000 {
        let (document, payload) = &links[round % links.len()];
        let mut bytes = payload.clone().into_bytes();
        match round % 4 {
            0 => bytes.truncate(random.below(bytes.len())),
            1 => {
                let other = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
                    [random.below(64)];
                let at = random.below(bytes.len());
                bytes[at] = other;
            }
            2 => {
                let (a, b) = (random.below(bytes.len()), random.below(bytes.len()));
                bytes.swap(a, b);
            }
            _ => {
                let at = random.below(bytes.len());
                bytes[at] ^= 1 << random.below(7);
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        match link::decode(&format!("#{text}")) {
            Ok(read) => assert_eq!(
                &read.document, document,
                "{text} silently is another document"
            ),
            Err(error) => {
                errors += 1;
                assert!(!error.to_string().contains('\n'), "one line: {error}");
            }
        }
    }
    println!("{errors} of 10000 damaged links refused, the rest unchanged in meaning");
    assert!(errors > 9_000, "only {errors} of 10000 were damaged at all");
}

#[test]
fn what_is_wrong_is_said() {
    let payload = link::encode(&document(json!({ "fabrica": 1, "title": "A title" })));
    let error = |text: &str| link::decode(text).expect_err(text);
    for empty in [
        "",
        " ",
        "#",
        "https://example.org/",
        "https://example.org/#",
        "https://example.org/?s=",
        "?doc=a.json",
        "?s=#",
        "#&step=2",
    ] {
        assert_eq!(error(empty), LinkError::Empty, "{empty:?}");
        assert!(!link::has_payload(empty), "{empty:?} is no payload");
    }
    for foreign in [
        "#top",
        "#section-2",
        "#AAAA",
        "#0",
        "#9abcdefgh",
        "#!/route",
        "hello",
        "#__",
    ] {
        assert!(
            matches!(error(foreign), LinkError::Foreign { .. } | LinkError::Empty),
            "{foreign}: {}",
            error(foreign)
        );
    }
    let cut = &payload[..payload.len() - 1];
    assert_eq!(
        error(cut).to_string(),
        format!(
            "the link is cut off: {} of {} characters are there",
            cut.len(),
            payload.len()
        )
    );
    assert_eq!(
        error(&format!("{payload}A")),
        LinkError::Damaged,
        "longer than it says"
    );
    assert!(
        matches!(error("1"), LinkError::CutOff { .. }),
        "only a version"
    );
    assert_eq!(
        error("1-----------"),
        LinkError::Damaged,
        "a length without end"
    );
    assert!(
        matches!(error("1AAAAAA"), LinkError::Damaged),
        "an empty code with a wrong checksum"
    );
}

#[test]
fn a_later_version_says_so() {
    // Version 2 of an unknown scheme, with the checksum that all versions share.
    let text = "2abcDEF_-";
    let mut crc = 0x3fff_ffff_u32;
    for bit in text
        .bytes()
        .flat_map(|byte| (0..8).rev().map(move |i| u32::from(byte >> i) & 1))
    {
        let top = crc >> 29 & 1;
        crc = crc << 1 & 0x3fff_ffff;
        if top != bit {
            crc ^= 0x2030_b9c7;
        }
    }
    crc ^= 0x3fff_ffff;
    let alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    let check: String = (0..5)
        .map(|i| char::from(alphabet[(crc >> (24 - 6 * i)) as usize & 63]))
        .collect();
    assert_eq!(
        link::decode(&format!("#{text}{check}")),
        Err(LinkError::NewerVersion { version: '2' })
    );
    assert!(
        matches!(
            link::decode(&format!("#{text}AAAAA")),
            Err(LinkError::Foreign { .. })
        ),
        "without its checksum it is foreign"
    );
}

#[test]
fn addresses_hold_payloads_in_many_ways() {
    let expected =
        document(json!({ "fabrica": 1, "title": "x", "templates": [{ "kind": "flap" }] }));
    let p = link::encode(&expected);
    for (text, step) in [
        (p.clone(), 0),
        (format!("#{p}"), 0),
        (format!(" #{p}\n"), 0),
        (format!("#{p}&step=3"), 3),
        (format!("{p}&step=12"), 12),
        (format!("https://a.org/b/?x=1#{p}"), 0),
        (format!("https://a.org/?s={p}"), 0),
        (format!("https://a.org/?s={p}&step=2"), 2),
        (format!("?lang=de&s={p}&utm=1&step=2"), 2),
        (format!("https://a.org/?step=3&s={p}"), 3),
        (format!("https://a.org/?s={p}#top"), 0),
        (format!("https://a.org/#{p}&utm_source=mail"), 0),
        (format!("https://a.org/#{p}?forced=1&step=4"), 4),
        (format!("https://a.org/#{p}%26step%3D4"), 0),
        (format!("#{p}&step=abc"), 0),
        (format!("#{p}&step=99999999999999999999"), 999_999),
        (format!("#{p}/&step=5#x"), 5),
        (format!("#{p}.&laststep=5"), 0),
        (format!("https://a.org/?s=1AAAA#{p}"), 0),
        (format!("file:///x.html#{p}:~:text=abc"), 0),
    ] {
        let read = link::decode(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((&read.document, read.step), (&expected, step), "of {text}");
        assert!(link::has_payload(&text), "{text} has one");
    }
    // The mark of a place in a page stands in nobody's way.
    assert!(!link::has_payload("https://a.org/?doc=a.json#top"));
    assert_eq!(link::fragment(&expected, 0), format!("#{p}"));
    assert_eq!(link::fragment(&expected, 3), format!("#{p}&step=3"));
}

#[test]
fn any_text_is_answered() {
    let mut random = Random(3);
    let alphabet: Vec<char> = "ABCxyz0123456789-_#?&=s/:.%é🧠\u{0} ".chars().collect();
    for _ in 0..20_000 {
        let n = random.below(60);
        let text: String = (0..n)
            .map(|_| alphabet[random.below(alphabet.len())])
            .collect();
        assert!(link::decode(&text).is_err(), "{text:?} is no link");
        let _either = Document::from_json(&text);
        let _either = link::decode(&format!("#1{text}"));
    }
}

#[test]
fn a_bomb_stops_at_the_limit() {
    // A document of one mebibyte that codes to next to nothing is a document; one byte more is refused before it is
    // made.
    let full = |n: usize| format!(r#"{{"fabrica":1,"title":"{}"}}"#, "a".repeat(n - 24));
    let largest = Document::from_json(&full(MAX_BYTES)).expect("a document of the largest size");
    assert_eq!(largest.byte_count(), MAX_BYTES);
    assert!(
        matches!(
            Document::from_json(&full(MAX_BYTES + 1)),
            Err(DocumentError::TooLarge { .. })
        ),
        "one more"
    );
    let started = Instant::now();
    let payload = link::encode(&largest);
    let read = link::decode(&payload)
        .expect("the largest document")
        .document;
    assert_eq!(read, largest, "the largest document survives");
    println!(
        "1 MiB in {} characters, both ways in {:?}",
        payload.len(),
        started.elapsed()
    );
    // Made by hand: a code that says nothing at all runs on and on.
    let started = Instant::now();
    for code in [
        "",
        "AAAA",
        "____",
        "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",
        "QUFB_w",
    ] {
        let result = link::decode(&with_envelope(code));
        let whole = result.map(|link| link.document.byte_count());
        assert!(
            whole.as_ref().map_or(true, |bytes| *bytes <= MAX_BYTES),
            "{code} gave {whole:?}"
        );
    }
    assert!(
        started.elapsed() < Duration::from_secs(60),
        "took {:?}",
        started.elapsed()
    );
}

/// A payload of version 1 around any code, with length and checksum as they should be.
fn with_envelope(code: &str) -> String {
    let alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    assert!(code.len() < 1024, "two groups of length");
    let mut text = "1".to_owned();
    if code.len() >= 32 {
        text.push(char::from(alphabet[(code.len() & 31) | 32]));
        text.push(char::from(alphabet[code.len() >> 5]));
    } else {
        text.push(char::from(alphabet[code.len()]));
    }
    text.push_str(code);
    let mut crc = 0x3fff_ffff_u32;
    for bit in text
        .bytes()
        .flat_map(|byte| (0..8).rev().map(move |i| u32::from(byte >> i) & 1))
    {
        let top = crc >> 29 & 1;
        crc = crc << 1 & 0x3fff_ffff;
        if top != bit {
            crc ^= 0x2030_b9c7;
        }
    }
    crc ^= 0x3fff_ffff;
    text.extend((0..5).map(|i| char::from(alphabet[(crc >> (24 - 6 * i)) as usize & 63])));
    text
}

#[test]
fn random_codes_with_right_checksums_are_answered() {
    const CODES: usize = 100;
    let mut random = Random(17);
    let alphabet: Vec<char> = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
        .chars()
        .collect();
    let mut documents = 0;
    for _ in 0..CODES {
        let n = random.below(80);
        let code: String = (0..n).map(|_| alphabet[random.below(64)]).collect();
        if let Ok(link) = link::decode(&with_envelope(&code)) {
            documents += 1;
            assert_eq!(
                Document::from_json(&link.document.to_json()).as_ref(),
                Ok(&link.document),
                "whatever it is, it is whole"
            );
        }
    }
    println!("{documents} of {CODES} random codes are documents");
}

/// The built-in arm with six handles, four steps and six labels.
fn bent_arm() -> Value {
    let label = |x: f64, y: f64, text: &str| json!({ "at": [x, y, 0], "text": text });
    json!({ "fabrica": 1, "title": "Flexion of the elbow", "subject": { "builtin": "drawn-arm" },
        "figure": { "handles": [
            { "region": "humerus" }, { "region": "ulna" }, { "region": "radius" }, { "region": "hand" },
            { "name": "biceps", "at": [-0.0712, 0.0831], "radius": 0.03 }, { "name": "triceps", "at": [-0.0844, -0.0672], "radius": 0.03 }] },
        "labels": [label(-0.21, 0.034, "Humerus"), label(0.187, -0.021, "Ulna"), label(0.193, 0.027, "Radius"),
            label(-0.083, 0.081, "Biceps"), label(-0.094, -0.068, "Triceps"), label(-0.031, 0.043, "Brachialis")],
        "steps": [
            { "title": "Extension", "set": { "/figure/handles/1/turn": 0.12, "/figure/handles/2/turn": 0.12, "/figure/handles/3/turn": 0.15 } },
            { "title": "31°", "set": { "/figure/handles/1/turn": 0.5411, "/figure/handles/1/move": [-0.0213, 0.0624],
                "/figure/handles/2/turn": 0.5411, "/figure/handles/4/scale": 1.1 } },
            { "title": "88°", "set": { "/figure/handles/1/turn": 1.5359, "/figure/handles/1/move": [-0.1427, 0.1532],
                "/figure/handles/2/turn": 1.5359, "/figure/handles/4/scale": 1.25, "/figure/handles/5/scale": 0.92 } },
            { "title": "Full flexion", "set": { "/figure/handles/1/turn": 2.4435, "/figure/handles/1/move": [-0.2618, 0.1209],
                "/figure/handles/2/turn": 2.4435, "/figure/handles/3/turn": 0.35, "/figure/handles/4/scale": 1.4 } }] })
}

/// A plate of twelve flooded regions with six handles and five steps.
fn flooded_plate() -> Value {
    let names = [
        "skin",
        "tibia",
        "fibula",
        "talus",
        "calcaneus",
        "navicular",
        "cuboid",
        "cuneiforms",
        "metatarsals",
        "toes",
        "Achilles tendon",
        "plantar fascia",
    ];
    let regions = names.iter().enumerate().map(|(i, name)| {
        let at = |k: usize| ((37 * i + 11 * k) % 97) as f64 / 97.0 - 0.5;
        let round = |x: f64| (x * 1000.0).round() / 1000.0;
        let mut region =
            json!({ "name": name, "from": { "flood": { "at": [[round(at(0)), round(at(1))]] } } });
        match i {
            1..10 => region["rigidity"] = json!("rigid"),
            0 => {}
            _ => region["rigidity"] = json!(4),
        }
        if i % 3 == 0 {
            region["from"]["flood"]["tolerance"] = json!(32);
            region["from"]["flood"]["gap"] = json!(2);
        }
        region
    });
    let steps = (1..6).map(|i| {
        let turn = |by: f64| (by * f64::from(i) * 1e4).round() / 1e4;
        json!({ "title": format!("Dorsal flexion {}°", 5 * i), "set": {
            "/figure/handles/1/turn": turn(0.0873), "/figure/handles/2/turn": turn(0.0611), "/figure/handles/4/move": [turn(-0.0042), turn(0.0093)] } })
    });
    json!({ "fabrica": 1, "title": "Foot", "subject": { "sha256": "7d793037a0760186574b0282f2f435e79c9a3d4f7e1b0c0a8e7a2f6f5e0d3c21", "name": "Foot" },
        "figure": { "regions": regions.collect::<Vec<_>>(), "handles": [
            { "region": "tibia" }, { "region": "talus" }, { "region": "calcaneus" }, { "region": "metatarsals" },
            { "at": [0.314, -0.231] }, { "at": [-0.127, 0.382], "radius": 0.02 }] },
        "steps": steps.collect::<Vec<_>>() })
}

#[test]
fn links_of_figures_are_short() {
    for (value, limit) in [(bent_arm(), 700), (flooded_plate(), 1200)] {
        let document = document(value);
        assert!(document.notices().is_empty(), "{:?}", document.notices());
        let payload = link::encode(&document);
        println!("{} of {limit} characters", payload.len());
        assert!(payload.len() < limit, "{}", payload.len());
    }
}

/// A clay of a ball with random strokes of up to four keys, with turns in every third.
fn stroked_ball(random: &mut Random, strokes: usize) -> Value {
    let whole = |random: &mut Random, most: i64| random.below(2 * most as usize + 1) as i64 - most;
    let strokes = (0..strokes).map(|i| {
        let keys = 1 + random.below(4);
        let step = |k: usize| if k < 3 { 600 } else { 200 };
        let path: Vec<i64> = (0..3 * keys).map(|k| whole(random, step(k))).collect();
        let mut stroke = json!({ "path": path });
        if i % 3 == 0 {
            let turns: Vec<i64> = (0..3 * keys).map(|_| whole(random, 90)).collect();
            stroke["turns"] = json!(turns);
        }
        stroke
    });
    json!({ "fabrica": 1, "subject": { "clay": { "strokes": strokes.collect::<Vec<_>>() } } })
}

#[test]
fn links_of_clays_are_short() {
    let mut longest = 0;
    for seed in 1..=8 {
        let document = document(stroked_ball(&mut Random(seed), 40));
        assert!(document.notices().is_empty(), "{:?}", document.notices());
        let payload = link::encode(&document);
        longest = longest.max(payload.len());
        assert_eq!(link::decode(&payload).expect("it opens").document, document);
    }
    println!("forty strokes on a ball: {longest} characters");
    assert!(longest < 1800, "{longest}");
}

/// Every link that a release made, one per line: payload, tab, the document's canonical JSON. Lines are never deleted
/// or changed. `FABRICA_BLESS=links` appends what the list below adds.
/// A clay that begins with a part of a volume, a built-in one or one of a file.
fn clays_of_volumes() -> [Value; 2] {
    let of = |from: Value| json!({ "fabrica": 1, "subject": { "clay": { "from": from, "strokes": [{ "path": [0, 0, 450, 0, 0, 200] }] } } });
    [
        of(json!({ "of": { "builtin": "torso" }, "segment": "liver" })),
        of(
            json!({ "of": { "sha256": "d".repeat(64), "name": "Chest", "frame": 1 }, "iso": 300, "walls": "all" }),
        ),
    ]
}

#[test]
fn clays_of_volumes_survive() {
    for value in clays_of_volumes() {
        let document = document(value);
        let read = link::decode(&link::encode(&document)).expect("a link");
        assert_eq!(read.document, document);
        assert_eq!(read.document.to_json_compact(), document.to_json_compact());
        assert_eq!(document.notices(), []);
    }
}

#[test]
fn golden_links_open_for_ever() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/links/v1.txt");
    let mut text = std::fs::read_to_string(&path).expect("the golden links are part of the tests");
    let mut wanted: Vec<Value> = vec![json!({ "fabrica": 1 })];
    for kind in TemplateKind::ALL {
        wanted.push(json!({ "fabrica": 1, "subject": { "builtin": "bar" }, "templates": [{ "kind": kind.spec().name, "at": [0.1, -0.2, 0.3] }] }));
    }
    wanted.push(json!({ "fabrica": 1, "subject": { "builtin": "bar" }, "templates": [{ "kind": "rbf", "params": { "points": [
        { "at": [0.2, 0.5, 0.5], "move": [0.1, 0, -0.05] }, { "at": [0.8, 0.5, 0.5] }], "cut": [[0.5, 0], [0.55, 1]], "extrude": true, "edge": 0.2 } }] }));
    wanted.push(json!({ "fabrica": 1, "templates": [{ "kind": "field", "params": { "sha256": "b".repeat(64), "name": "Warp", "units": "subject" } }] }));
    wanted.push(json!({ "fabrica": 1, "templates": [{ "kind": "peel", "size": [0.5, 0.4, 0.2], "curve": { "points": [[0, 0.4], [0.5, 1], [1, 0.55]] } },
        { "kind": "poke", "curve": { "points": [[0, 1], [0.5, 1.2], [1, 1]], "spline": false } }] }));
    wanted.push(json!({ "fabrica": 1, "objects": [{ "builtin": "scalpel", "name": "knife", "at": [0.1, 0.3, 0.2] }],
        "templates": [{ "kind": "carve", "params": { "object": "knife", "push": 0.01, "reach": 0.2 }, "amount": 0.5 }],
        "steps": [{ "title": "In", "set": { "/objects/0/at": [0.1, 0.3, 0.05], "/templates/0/params/push": 0.02 } }] }));
    wanted.push(lesson(&mut Random(2026)));
    wanted.push(Random(1543).document());
    wanted.push(json!({ "fabrica": 1, "title": "Дом 家 🧠", "x-unknown": { "deep": [null, true, 1e-7, -2.5e300, 18_446_744_073_709_551_615_u64] } }));
    wanted.push(json!({ "fabrica": 1, "subject": { "sha256": "a".repeat(64), "name": "CT head" }, "look": { "transfer": [{ "value": 40, "color": "#c88a6a", "opacity": 0.2 }], "background": "none" } }));
    wanted.push(json!({ "fabrica": 1, "subject": { "meshes": [{ "src": "talus.stl", "name": "talus" }, { "sha256": "c".repeat(64), "name": "skin", "units": "m", "axes": "y-up",
        "parts": "pieces", "smooth": 30 }], "box": [-40, -30, -20, 40, 30, 20] },
        "objects": [{ "builtin": "scalpel", "name": "knife", "at": [0.1, 0.3, 0.2], "rotate": [0, 0, 0.6, 0.8], "opacity": 0.5 }, { "src": "plate.glb", "color": "#808080" }],
        "look": { "body": "solid", "thickness": 0.05, "inside": "#804030", "layers": [{ "depth": 0, "name": "rind", "color": "#b8433a" }, { "depth": 0.01, "name": "flesh",
        "color": "#f2e3b3", "grain": 0.1 }], "gloss": 0.2, "segments": { "talus": { "opacity": 0.4, "body": "hollow" } } },
        "steps": [{ "title": "In", "set": { "/objects/0/at": [0.1, 0.3, 0.05] } }] }));
    wanted.push(bent_arm());
    wanted.push(flooded_plate());
    wanted.push(json!({ "fabrica": 1, "subject": { "clay": { "from": { "shape": "plate" }, "detail": 0.03,
        "tools": [{ "radius": 0.2, "coat": 0.15 }, { "shape": "box", "half": [0.2, 0.3, 0.3], "round": 0.05, "coat": 0.3 }, { "shape": "later", "size": 2 }],
        "strokes": [{ "path": [100, 0, 400, 0, 0, -360], "turns": [0, 0, 40], "scales": [100, 80], "mirror": "x" },
            { "tool": 1, "path": [-560, 0, 0, 0, 0, 0], "turns": [0, 0, 0, -50, 0, 0], "straight": true,
            "with": [{ "tool": 1, "path": [560, 0, 0, 0, 0, 0], "turns": [0, 0, 0, 50, 0, 0], "straight": true }] },
            { "do": "smooth", "strength": 30, "path": [0, 0, 80, 90, 0, 0], "off": true }] } }, "look": { "strokes": 1 },
        "labels": [{ "at": [0, 0, 0.07], "text": "Bowl" }], "steps": [{ "title": "Wrung", "set": { "/look/strokes": 3 } }] }));
    wanted.push(json!({ "fabrica": 1, "subject": { "src": "face.svg", "name": "Face" }, "figure": {
        "regions": [{ "name": "jaw", "from": { "path": "jaw-2" }, "rigidity": "rigid", "order": 2, "cut": true, "behind": "smooth" },
            { "name": "skin", "from": { "polygon": [[-0.5, -0.4], [0.5, -0.4], [0, 0.4]] }, "rigidity": [1, 4], "behind": "#e8c8b0", "fixed": true },
            { "name": "paper", "from": { "flood": { "at": [[0.4, 0.4]], "connected": false } }, "fill": true, "hide": true }],
        "handles": [{ "points": [[-0.1, 0], [0, 0.02], [0.1, 0]], "to": [[-0.1, 0.02], [0, 0], [0.1, 0.02]], "radius": 0.02 }],
        "only": [[-0.5, -0.5], [0.5, -0.5], [0.5, 0], [-0.5, 0]], "propagation": "gaussian", "reach": 0.4, "rotations": "propagated",
        "context": { "points": [[-0.1, 0.1], [0.1, 0.1], [0, -0.1]], "strength": 8, "like": [[0, 0], [80, 4], [38, 95]], "amount": 0.7 },
        "contours": [{ "region": "jaw", "like": [[0, 0], [1, 0], [0.5, 0.7]], "mirror": true, "keep": [[0, 0.1]] }],
        "rest": "drop", "detail": 9000 }, "steps": [{ "set": { "/figure/handles/0/to": [[-0.1, 0], [0, 0.03], [0.1, 0]], "/figure/context/amount": 1 } }] }));
    wanted.extend(clays_of_volumes());
    if std::env::var("FABRICA_BLESS").as_deref() == Ok("links") {
        for value in wanted.clone() {
            let document = document(value);
            let line = format!(
                "{}\t{}\n",
                link::encode(&document),
                document.to_json_compact()
            );
            if !text.contains(&line) {
                text.push_str(&line);
            }
        }
        std::fs::write(&path, &text).expect("the golden links are written");
    }
    for (i, line) in text.lines().enumerate() {
        let (payload, json) = line.split_once('\t').expect("payload, tab, JSON");
        let read = link::decode(payload).unwrap_or_else(|error| panic!("line {}: {error}", i + 1));
        assert_eq!(read.document.to_json_compact(), json, "line {}", i + 1);
    }
    for value in wanted {
        let payload = link::encode(&document(value));
        assert!(
            text.contains(&format!("{payload}\t")),
            "the coder changed: {payload} is not in the golden file"
        );
    }
}

#[test]
fn an_edited_document_has_a_short_link() {
    let mut history = History::new(Document::new());
    let placement = fabrica::math::Placement {
        at: glam::Vec3::new(0.123_456_7, 0.2, -0.3),
        ..fabrica::math::Placement::DOCUMENT_DEFAULT
    };
    history
        .apply(&Edit::AddTemplate {
            index: 0,
            kind: TemplateKind::Peel,
            placement,
        })
        .expect("a peel");
    history
        .apply(&Edit::SetParam {
            template: 0,
            param: "progress",
            value: ParamValue::Number(0.712_345_6),
        })
        .expect("opened");
    assert_eq!(
        history.document().to_json_compact(),
        r#"{"fabrica":1,"templates":[{"kind":"peel","at":[0.1235,0.2,-0.3],"params":{"progress":0.7123}}]}"#
    );
    assert!(
        link::encode(history.document()).len() < 50,
        "rounding keeps links short"
    );
}
