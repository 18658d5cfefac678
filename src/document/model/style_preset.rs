//! The named styles that a document's `look.style` may name.

use super::style::{Hatch, HatchBy, Outline, Style, Tone};

/// A named style.
#[derive(Debug)]
pub struct StylePreset {
    /// As written in documents.
    pub name: &'static str,
    /// English name that the interface shows.
    pub title: &'static str,
    /// What is drawn.
    pub style: Style,
}

impl StylePreset {
    /// Names in documents, `none` first, then those of [`STYLE_PRESETS`] in their order.
    pub(crate) const NAMES: [&'static str; STYLE_PRESETS.len() + 1] = {
        let mut names = ["none"; STYLE_PRESETS.len() + 1];
        let mut i = 0;
        while i < STYLE_PRESETS.len() {
            names[i + 1] = STYLE_PRESETS[i].name;
            i += 1;
        }
        names
    };
}

/// Every preset, in the order in which they are offered. Names never change; new ones are added.
pub const STYLE_PRESETS: &[StylePreset] = &[
    StylePreset {
        name: "atlas",
        title: "Atlas",
        style: Style {
            outline: outline(1.2, 0x3a2a20, 0.4),
            tone: tone(0.35, 0, 0xfbe6c8, 0x4a5a78),
            ..Style::PLAIN
        },
    },
    StylePreset {
        name: "ink",
        title: "Ink",
        style: Style {
            outline: outline(2.0, 0x111111, 0.7),
            tone: tone(1.0, 0, 0xffffff, 0xffffff),
            hatch: Hatch {
                spacing: 7.5,
                width: 1.2,
                by: HatchBy::Axis,
                color_srgb: rgb(0x111111),
                strength: 1.0,
            },
            ..Style::PLAIN
        },
    },
    StylePreset {
        name: "pencil",
        title: "Pencil",
        style: Style {
            outline: outline(1.2, 0x4a4a4a, 0.5),
            tone: tone(1.0, 0, 0xf6f2ea, 0xc9c4ba),
            hatch: Hatch {
                spacing: 6.0,
                width: 0.9,
                by: HatchBy::Curvature,
                color_srgb: rgb(0x4a4a4a),
                strength: 0.8,
            },
            ..Style::PLAIN
        },
    },
    StylePreset {
        name: "textbook",
        title: "Textbook",
        style: Style {
            outline: outline(2.0, 0x20242c, 0.6),
            tone: tone(0.5, 3, 0xfff0d8, 0x5a6c8c),
            ..Style::PLAIN
        },
    },
    StylePreset {
        name: "blueprint",
        title: "Blueprint",
        style: Style {
            outline: outline(1.6, 0xffffff, 0.6),
            tone: tone(1.0, 0, 0x1d4f91, 0x1d4f91),
            hatch: Hatch {
                spacing: 8.0,
                width: 1.0,
                by: HatchBy::Axis,
                color_srgb: rgb(0xcfe3ff),
                strength: 0.7,
            },
            ..Style::PLAIN
        },
    },
];

/// The preset of a name; `None` for `none` and for names that this version does not know.
pub fn style_preset(name: &str) -> Option<&'static StylePreset> {
    STYLE_PRESETS.iter().find(|preset| preset.name == name)
}

const fn rgb(color: u32) -> [u8; 3] {
    [(color >> 16) as u8, (color >> 8) as u8, color as u8]
}

const fn outline(width: f32, color: u32, creases: f32) -> Outline {
    Outline {
        width,
        color_srgb: rgb(color),
        creases,
    }
}

const fn tone(strength: f32, levels: u32, warm: u32, cool: u32) -> Tone {
    Tone {
        levels,
        warm_srgb: rgb(warm),
        cool_srgb: rgb(cool),
        strength,
    }
}
