use std::sync::Arc;

/// A view of a whole texture, which is given back to the device when nobody holds the view any more. A browser would
/// give it back late.
#[derive(Debug)]
pub(crate) struct HeldView(wgpu::TextureView);

impl HeldView {
    pub(crate) fn new(texture: &wgpu::Texture) -> Arc<Self> {
        Arc::new(Self(texture.create_view(&Default::default())))
    }
}

impl Drop for HeldView {
    fn drop(&mut self) {
        self.0.texture().destroy();
    }
}

impl HeldView {
    /// Bytes of the texture.
    pub(crate) fn bytes(&self) -> u64 {
        let texture = self.0.texture();
        let texels = texture.size();
        let texel = texture.format().block_copy_size(None).unwrap_or(0);
        [
            texels.width,
            texels.height,
            texels.depth_or_array_layers,
            texel,
        ]
        .into_iter()
        .map(u64::from)
        .product()
    }
}

impl std::ops::Deref for HeldView {
    type Target = wgpu::TextureView;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}
