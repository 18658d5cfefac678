//! Numbers and bytes as text shows them.

/// A number rounded to this many decimals, halves away from zero.
pub fn round_to(value: f64, decimals: u8) -> f64 {
    // Powers of ten up to 10^22 are exact.
    let scale = 10_f64.powi(i32::from(decimals));
    (value * scale).round() / scale
}

/// A 32-bit float as the 64-bit float that prints the same: 0.1, not 0.10000000149011612.
pub fn plain_f64(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

/// Bytes as lower-case hexadecimal digits, two for each byte: how documents write hashes.
pub fn hex(bytes: &[u8]) -> String {
    let digit = |value: u8| char::from_digit(u32::from(value), 16).unwrap_or('0');
    let digits = bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]);
    digits.map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_bytes_are_written_as_documents_have_them() {
        assert_eq!(round_to(0.123_456, 4), 0.1235);
        assert_eq!(round_to(-2.675, 2), -2.68);
        assert_eq!(round_to(123_456.0, 4), 123_456.0);
        assert_eq!(plain_f64(0.1), 0.1);
        assert_eq!(hex(&[0, 0x0f, 0xa5, 255]), "000fa5ff");
    }
}
