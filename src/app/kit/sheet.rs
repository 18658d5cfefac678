//! Pictures that ship with the program: a sheet of equal tiles in one texture.

use egui::{ColorImage, Context, Rect, TextureHandle, TextureId, TextureOptions, Vec2, pos2, vec2};

use crate::render::{Image, RenderError, decode_png};

/// A picture of equal tiles, counted row by row from the top left. Made once per window; holds one texture.
pub(crate) struct Sheet {
    texture: TextureHandle,
    tile_px: Vec2,
    columns: usize,
}

impl Sheet {
    /// The sheet of a PNG file with tiles of `tile_px` (width and height, pixels).
    ///
    /// # Errors
    /// [`RenderError::NotPng`].
    pub(crate) fn new(
        ctx: &Context,
        name: &str,
        png: &[u8],
        tile_px: [u32; 2],
    ) -> Result<Self, RenderError> {
        Ok(Self::of(ctx, name, &decode_png(png)?, tile_px))
    }

    /// A picture of one tile.
    ///
    /// # Errors
    /// [`RenderError::NotPng`].
    pub(crate) fn whole(ctx: &Context, name: &str, png: &[u8]) -> Result<Self, RenderError> {
        let image = decode_png(png)?;
        Ok(Self::of(ctx, name, &image, image.size))
    }

    fn of(ctx: &Context, name: &str, image: &Image, tile_px: [u32; 2]) -> Self {
        let size = image.size.map(|side| side as usize);
        let pixels = ColorImage::from_rgba_unmultiplied(size, &image.rgba);
        let [width, height] = tile_px;
        Self {
            texture: ctx.load_texture(name, pixels, TextureOptions::LINEAR),
            tile_px: vec2(width as f32, height as f32),
            columns: (image.size[0] / width.max(1)).max(1) as usize,
        }
    }

    /// The texture and the part of it that the tile of this index covers. A margin of half a pixel keeps the neighbours
    /// out where the tile is drawn smaller.
    pub(crate) fn tile(&self, index: usize) -> (TextureId, Rect) {
        let (column, row) = (index % self.columns, index / self.columns);
        let min = pos2(column as f32, row as f32).to_vec2() * self.tile_px;
        let tile = Rect::from_min_size(min.to_pos2(), self.tile_px).shrink(0.5);
        let size = self.texture.size_vec2();
        let part = |pos: egui::Pos2| (pos.to_vec2() / size).to_pos2();
        let uv = Rect::from_min_max(part(tile.min), part(tile.max));
        (self.texture.id(), uv)
    }
}
