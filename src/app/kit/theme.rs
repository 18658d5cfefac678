//! Colours, type and spacing of the program, light and dark. Every colour that a panel, an icon or the gizmo uses is
//! named here.

use std::cell::Cell;
use std::sync::Arc;

use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke,
    TextStyle, Theme, Vec2, epaint::text::FontTweak, style::HandleShape,
};

/// The family of headings and of names that carry weight (Inter SemiBold).
pub(crate) const STRONG: &str = "strong";

/// Points of an ordinary control's height: for a mouse, or for a thumb, which with the space between controls has 44.
pub(crate) fn control_height() -> f32 {
    if is_touch() { 40.0 } else { 28.0 }
}

/// The colours that egui's own style has no place for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Palette {
    /// Behind bars and panels.
    pub panel: Color32,
    /// A step up from `panel`: cards, the selected tab, pop-ups.
    pub raised: Color32,
    /// A step down: tracks, wells, text fields.
    pub sunken: Color32,
    /// Hair lines that separate and frame.
    pub line: Color32,
    /// Ordinary text on `panel` and `raised`.
    pub text: Color32,
    /// Text of second rank; still 4.5:1 on `panel`.
    pub weak: Color32,
    /// The chosen entry, and the one main button.
    pub accent: Color32,
    /// `accent` under the pointer.
    pub accent_hover: Color32,
    /// Text and icons on `accent`.
    pub on_accent: Color32,
    /// A wash of `accent` behind a chosen entry.
    pub accent_wash: Color32,
    /// Behind a row or a button under the pointer.
    pub hover: Color32,
    /// Text and marks of warnings.
    pub warning: Color32,
    /// Text and marks of errors, and buttons that delete.
    pub danger: Color32,
    /// Behind text that floats over the picture.
    pub float: Color32,
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// Paper, ink and a surgical green that stands apart from every tissue colour.
const LIGHT: Palette = Palette {
    panel: rgb(0xf5f5f3),
    raised: rgb(0xffffff),
    sunken: rgb(0xe9e9e6),
    line: rgb(0xd9d9d4),
    text: rgb(0x1f2426),
    weak: rgb(0x5c6366),
    accent: rgb(0x0f6f6a),
    accent_hover: rgb(0x0b5e59),
    on_accent: rgb(0xffffff),
    accent_wash: rgb(0xd7ebe8),
    hover: rgb(0xebebe8),
    warning: rgb(0x8a5a00),
    danger: rgb(0xb3372f),
    float: Color32::from_rgba_premultiplied(242, 242, 240, 242),
};

const DARK: Palette = Palette {
    panel: rgb(0x1d2022),
    raised: rgb(0x2a2e31),
    sunken: rgb(0x141617),
    line: rgb(0x363b3e),
    text: rgb(0xe7e9e8),
    weak: rgb(0xa2a9ab),
    accent: rgb(0x4fb9b0),
    accent_hover: rgb(0x6bcbc3),
    on_accent: rgb(0x0b1f1e),
    accent_wash: rgb(0x1f3f3d),
    hover: rgb(0x2f3437),
    warning: rgb(0xe0ad55),
    danger: rgb(0xee8277),
    float: Color32::from_rgba_premultiplied(28, 31, 33, 240),
};

/// High contrast: text 7:1 and more on its background, lines 3:1, nothing told by a tint alone.
const LIGHT_CONTRAST: Palette = Palette {
    panel: rgb(0xffffff),
    raised: rgb(0xffffff),
    sunken: rgb(0xf0f0f0),
    line: rgb(0x5a5a5a),
    text: rgb(0x000000),
    weak: rgb(0x2b2b2b),
    accent: rgb(0x004a46),
    accent_hover: rgb(0x00302d),
    on_accent: rgb(0xffffff),
    accent_wash: rgb(0xcfe9e6),
    hover: rgb(0xe4e4e4),
    warning: rgb(0x5c3a00),
    danger: rgb(0x8a0f08),
    float: rgb(0xffffff),
};

const DARK_CONTRAST: Palette = Palette {
    panel: rgb(0x000000),
    raised: rgb(0x000000),
    sunken: rgb(0x161616),
    line: rgb(0xb5b5b5),
    text: rgb(0xffffff),
    weak: rgb(0xe0e0e0),
    accent: rgb(0x7ff0e4),
    accent_hover: rgb(0xb5fff7),
    on_accent: rgb(0x000000),
    accent_wash: rgb(0x07403b),
    hover: rgb(0x2a2a2a),
    warning: rgb(0xffd27a),
    danger: rgb(0xffaaa2),
    float: rgb(0x000000),
};

thread_local! {
    /// As with the language: one reader looks at all viewers on this thread.
    static HAS_CONTRAST: Cell<bool> = const { Cell::new(false) };
    static IS_TOUCH: Cell<bool> = const { Cell::new(false) };
}

/// True while controls are made for fingers.
pub(crate) fn is_touch() -> bool {
    IS_TOUCH.get()
}

/// Of a text for who has a mouse and one for fingers, the one that fits.
pub(crate) fn by_hand([by_mouse, by_finger]: [&'static str; 2]) -> &'static str {
    if is_touch() { by_finger } else { by_mouse }
}

/// Makes controls for fingers, or for a mouse. Seen from the next frame on.
pub(crate) fn set_touch(ctx: &egui::Context, is_touch: bool) {
    if IS_TOUCH.replace(is_touch) != is_touch {
        set_contrast(ctx, has_contrast());
        ctx.request_repaint();
    }
}

/// True while the contrast is high.
pub(crate) fn has_contrast() -> bool {
    HAS_CONTRAST.get()
}

/// Sets the contrast and gives both themes of a context its colours.
pub(crate) fn set_contrast(ctx: &egui::Context, is_high: bool) {
    HAS_CONTRAST.set(is_high);
    for theme in [Theme::Light, Theme::Dark] {
        ctx.style_mut_of(theme, |style| apply(style, Palette::of(theme)));
    }
}

/// Colours of the gizmo, the same over every theme since they lie on the picture.
pub(crate) mod over_picture {
    use super::{Color32, rgb};
    /// Along the template's x axis.
    pub(crate) const X: Color32 = rgb(0xd8433b);
    /// Along the template's y axis.
    pub(crate) const Y: Color32 = rgb(0x3f9a3a);
    /// Along the template's z axis.
    pub(crate) const Z: Color32 = rgb(0x2c6fd6);
    /// Edges of the template's box.
    pub(crate) const BOX: Color32 = rgb(0x0f6f6a);
    /// The handle of the main parameter.
    pub(crate) const HANDLE: Color32 = rgb(0xf2a900);
    /// Under the pointer or held.
    pub(crate) const HOT: Color32 = rgb(0xffd34d);
    /// Values that a range takes, over the grey of slices: the interface's own colour, light enough on black.
    pub(crate) const TAKEN: Color32 = rgb(0x4fb9b0);
    /// Around lines and letters, so that they read on flesh, bone, white and black.
    pub(crate) const HALO_LIGHT: Color32 = Color32::from_rgba_premultiplied(215, 215, 215, 215);
    /// A dark halo, for the same purpose as `HALO_LIGHT`.
    pub(crate) const HALO_DARK: Color32 = Color32::from_rgba_premultiplied(0, 0, 0, 150);
}

/// Marks of groups in the list; each 3:1 on `raised` in every theme.
pub(crate) const GROUPS: [Color32; 4] =
    [rgb(0xc0632b), rgb(0x4a7fd0), rgb(0x9a5fc0), rgb(0x4a9a3a)];

impl Palette {
    /// The colours of a theme.
    pub(crate) fn of(theme: Theme) -> &'static Self {
        match (theme, has_contrast()) {
            (Theme::Light, false) => &LIGHT,
            (Theme::Dark, false) => &DARK,
            (Theme::Light, true) => &LIGHT_CONTRAST,
            (Theme::Dark, true) => &DARK_CONTRAST,
        }
    }

    /// The colours of the theme that a piece of interface is drawn in.
    pub(crate) fn get(ui: &egui::Ui) -> &'static Self {
        Self::of(if ui.visuals().dark_mode {
            Theme::Dark
        } else {
            Theme::Light
        })
    }
}

/// Text set in the heavier cut.
pub(crate) fn strong(text: impl Into<String>) -> egui::RichText {
    egui::RichText::new(text).family(FontFamily::Name(STRONG.into()))
}

/// Font of the heavier cut at a size in points.
pub(crate) fn strong_font(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(STRONG.into()))
}

/// True if every letter of a text can be drawn. The page draws what the fonts lack with the browser's own.
pub(crate) fn can_draw(ui: &egui::Ui, text: &str) -> bool {
    let font = FontId::proportional(13.0);
    cfg!(target_arch = "wasm32") || ui.fonts_mut(|fonts| fonts.has_glyphs(&font, text))
}

/// Draws letters that none of the fonts has. A browser draws such letters on a canvas and reads them back, and the
/// first reading waits for all that the graphics device has to do: in the first frame that is nothing, later half a
/// second.
pub(crate) fn warm(ui: &egui::Ui) {
    if cfg!(target_arch = "wasm32") {
        let font = FontId::proportional(13.0);
        let letters = crate::app::words::Lang::Chinese.own_name().to_owned();
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(letters, font, Color32::BLACK));
    }
}

/// Puts fonts and both themes into a context. Once, at the start.
pub(crate) fn install(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    set_contrast(ctx, has_contrast());
}

/// Inter in two cuts, cut down to Latin and Greek. Other scripts are drawn by the browser's own text engine, or
/// natively by the fonts of the system.
fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    // Inter's own line gap is nothing and its ascent is high: one pixel down centres it in a button.
    let tweak = FontTweak {
        y_offset_factor: 0.01,
        ..Default::default()
    };
    for (name, bytes) in [
        ("inter", include_bytes!("font/Inter-Regular.otf").as_slice()),
        (
            "inter-semibold",
            include_bytes!("font/Inter-SemiBold.otf").as_slice(),
        ),
    ] {
        let data = FontData::from_static(bytes).tweak(tweak.clone());
        fonts.font_data.insert(name.to_owned(), Arc::new(data));
    }
    let regular = vec!["inter".to_owned()];
    fonts
        .families
        .insert(FontFamily::Proportional, regular.clone());
    fonts.families.insert(FontFamily::Monospace, regular);
    fonts.families.insert(
        FontFamily::Name(STRONG.into()),
        vec!["inter-semibold".to_owned(), "inter".to_owned()],
    );
    fonts
}

fn apply(style: &mut egui::Style, palette: &Palette) {
    style.text_styles = [
        (TextStyle::Small, FontId::proportional(11.5)),
        (TextStyle::Body, FontId::proportional(13.5)),
        (TextStyle::Button, FontId::proportional(13.5)),
        (TextStyle::Heading, strong_font(15.0)),
        (TextStyle::Monospace, FontId::proportional(13.0)),
    ]
    .into();
    style.animation_time = 0.12;
    style.interaction.tooltip_delay = 0.4;
    style.interaction.interact_radius = if is_touch() { 9.0 } else { 5.0 };
    style.interaction.selectable_labels = false;

    let spacing = &mut style.spacing;
    let is_touch = is_touch();
    spacing.item_spacing = Vec2::new(8.0, if is_touch { 4.0 } else { 6.0 });
    spacing.button_padding = Vec2::new(10.0, 5.0);
    spacing.interact_size = Vec2::new(36.0, control_height());
    spacing.slider_rail_height = 4.0;
    spacing.icon_width = if is_touch { 22.0 } else { 16.0 };
    spacing.icon_width_inner = if is_touch { 12.0 } else { 9.0 };
    spacing.combo_width = 96.0;
    spacing.combo_height = if is_touch { 420.0 } else { 300.0 };
    spacing.menu_margin = Margin::same(6);
    spacing.window_margin = Margin::same(16);
    spacing.scroll.floating = true;
    spacing.scroll.bar_width = 8.0;

    let visuals = &mut style.visuals;
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.raised;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.window_corner_radius = CornerRadius::same(10);
    visuals.menu_corner_radius = CornerRadius::same(8);
    visuals.extreme_bg_color = palette.sunken;
    visuals.text_edit_bg_color = Some(palette.raised);
    visuals.faint_bg_color = palette.sunken;
    visuals.code_bg_color = palette.sunken;
    visuals.hyperlink_color = palette.accent;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.danger;
    visuals.weak_text_color = Some(palette.weak);
    visuals.selection.bg_fill = palette.accent_wash;
    visuals.selection.stroke = Stroke::new(1.5, palette.accent);
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = HandleShape::Circle;
    let shadow = Shadow {
        offset: [0, 6],
        blur: 20,
        spread: 0,
        color: Color32::from_black_alpha(if visuals.dark_mode { 110 } else { 38 }),
    };
    visuals.popup_shadow = shadow;
    visuals.window_shadow = shadow;
    visuals.disabled_alpha = 0.45;

    let radius = CornerRadius::same(6);
    let widgets = &mut visuals.widgets;
    for (visual, fill, weak_fill, stroke, text) in [
        (
            &mut widgets.noninteractive,
            palette.panel,
            palette.panel,
            palette.line,
            palette.text,
        ),
        (
            &mut widgets.inactive,
            palette.sunken,
            palette.raised,
            palette.line,
            palette.text,
        ),
        (
            &mut widgets.hovered,
            palette.hover,
            palette.hover,
            palette.weak,
            palette.text,
        ),
        (
            &mut widgets.active,
            palette.accent_wash,
            palette.accent_wash,
            palette.accent,
            palette.text,
        ),
        (
            &mut widgets.open,
            palette.hover,
            palette.hover,
            palette.accent,
            palette.text,
        ),
    ] {
        visual.bg_fill = fill;
        visual.weak_bg_fill = weak_fill;
        visual.bg_stroke = Stroke::new(1.0, stroke);
        visual.fg_stroke = Stroke::new(1.5, text);
        visual.corner_radius = radius;
        visual.expansion = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance (WCAG 2.2).
    fn luminance(color: Color32) -> f32 {
        let linear = egui::Rgba::from(color);
        0.2126 * linear.r() + 0.7152 * linear.g() + 0.0722 * linear.b()
    }

    fn contrast(a: Color32, b: Color32) -> f32 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn what_is_written_can_be_read() {
        let themes = [
            ("light", LIGHT, 4.5, 1.0),
            ("dark", DARK, 4.5, 1.0),
            ("light, high", LIGHT_CONTRAST, 7.0, 3.0),
            ("dark, high", DARK_CONTRAST, 7.0, 3.0),
        ];
        for (name, p, letters, lines) in themes {
            for (what, ink, ground) in [
                ("text on panel", p.text, p.panel),
                ("text on raised", p.text, p.raised),
                ("text on sunken", p.text, p.sunken),
                ("text on hover", p.text, p.hover),
                ("weak on panel", p.weak, p.panel),
                ("weak on raised", p.weak, p.raised),
                ("accent on raised", p.accent, p.raised),
                ("text on the wash", p.text, p.accent_wash),
                ("on the main button", p.on_accent, p.accent),
                ("on the main button, hot", p.on_accent, p.accent_hover),
                ("warning on panel", p.warning, p.panel),
                ("danger on panel", p.danger, p.panel),
            ] {
                let found = contrast(ink, ground);
                assert!(found >= letters, "{name}: {what} {found:.2}");
            }
            let found = contrast(p.line, p.raised);
            assert!(found >= lines, "{name}: lines {found:.2}");
            for group in GROUPS {
                let found = contrast(group, p.raised);
                assert!(found >= 3.0, "{name}: mark of a group {found:.2}");
            }
        }
    }
}
