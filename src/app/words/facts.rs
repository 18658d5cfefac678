//! What is known of the scan that is shown.

words! {
    /// Names of the facts of a scan.
    Facts {
        about: "About this scan", "Über diesen Scan", "Acerca de este estudio", "关于此扫描";
        name: "Name", "Name", "Nombre", "名称";
        voxels: "Voxels", "Voxel", "Vóxeles", "体素";
        spacing: "Spacing", "Abstand", "Espaciado", "间距";
        size: "Size", "Größe", "Tamaño", "尺寸";
        values: "Values", "Werte", "Valores", "数值";
        from_to: "{0} to {1}", "{0} bis {1}", "de {0} a {1}", "{0} 至 {1}";
        segments: "Segments", "Segmente", "Segmentos", "分割";
    }
}
