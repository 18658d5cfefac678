/// A picture, unpacked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    /// Width and height, pixels; none of them 0.
    pub size: [u32; 2],
    /// Red, green and blue as sRGB bytes and alpha, 0 to 255, not multiplied; row by row from the top, each from the
    /// left.
    pub pixels: Vec<[u8; 4]>,
    /// True if the file mixes inks (CMYK or YCCK), whose colours were taken by inversion.
    pub is_of_inks: bool,
}

impl Picture {
    /// Bytes of the pixels.
    pub fn byte_len(&self) -> u64 {
        4 * self.pixels.len() as u64
    }

    /// Makes every pixel opaque; colours stay as they are.
    pub fn make_opaque(&mut self) {
        for pixel in &mut self.pixels {
            pixel[3] = 255;
        }
    }
}
