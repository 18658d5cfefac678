/// Options of reading a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadOptions {
    /// Which volume of a file that holds several, from 0.
    pub frame: u64,
    /// More voxels are refused before any memory is asked for. The default is 2³³ (a cube of 2,048): beyond it, not
    /// even reduction is quick.
    pub max_voxels: u64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self {
            frame: 0,
            max_voxels: 1 << 33,
        }
    }
}
