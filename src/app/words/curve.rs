//! A template along a curve.

words! {
    /// Texts of the curve along which a template lies.
    Curved {
        curve: "Along", "Verlauf", "Trazado", "走向";
        hint: "The template is bent along its length and keeps its thickness", "Die Vorlage biegt sich der Länge nach und bleibt gleich dick", "La plantilla se curva a lo largo y conserva su grosor", "模板沿长度弯曲，厚度不变";
        follow: "Follow the surface", "Oberfläche folgen", "Seguir la superficie", "沿表面";
        follow_hint: "Lays the template along the surface under it", "Legt die Vorlage an der Oberfläche unter ihr entlang", "Coloca la plantilla a lo largo de la superficie bajo ella", "将模板沿其下方的表面铺设";
        straight: "Make it straight", "Gerade machen", "Poner recta", "恢复为直线";
        round: "Round", "Rund", "Redondeado", "圆滑";
        round_hint: "Round through the points of the curve, or straight from each to the next", "Rund durch die Punkte der Kurve oder gerade von einem zum nächsten", "Redondeado por los puntos de la curva, o recto de uno a otro", "经过各点的圆滑曲线，或逐点直线";
        point: "Curve point {0}", "Kurvenpunkt {0}", "Punto de la curva {0}", "曲线点 {0}";
    }
}
