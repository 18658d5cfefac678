//! What scripts of a page may wish for before the program starts.

/// Samples a pixel of finished pictures: the number `fabricaSamples` of the page's global object, if there is one. For
/// tests, and for devices on which somebody knows better than the program.
pub(super) fn samples() -> Option<u32> {
    let wished = js_sys::Reflect::get(&js_sys::global(), &"fabricaSamples".into()).ok()?;
    wished.as_f64().map(|number| number as u32)
}
