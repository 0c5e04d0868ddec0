"""Materials by name: linear Rec. 709 reflectance, or luminance in nits for what glows.

The values are those of ordinary interiors: painted plaster 0.7 to 0.85, light wood 0.3 to 0.5,
carpet 0.15 to 0.3, paper 0.75, black plastic 0.04. Nothing is whiter than fresh white paint.
"""

REFLECTANCE = {
    # shells
    "WhiteWall": (0.78, 0.76, 0.72), "Ceiling": (0.84, 0.84, 0.82), "Plaster": (0.72, 0.71, 0.69),
    "AccentWall": (0.20, 0.34, 0.36), "Carpet": (0.21, 0.22, 0.24), "Parquet": (0.40, 0.26, 0.15),
    "Skirting": (0.74, 0.73, 0.70), "DoorPaint": (0.66, 0.66, 0.63),
    "NightGlass": (0.015, 0.022, 0.045), "FrameWhite": (0.76, 0.76, 0.74),
    "RedWall": (0.46, 0.075, 0.055), "BlueWall": (0.10, 0.17, 0.33),
    "OchreWall": (0.60, 0.40, 0.14), "StoneFloor": (0.36, 0.35, 0.33),
    "CornellWhite": (0.73, 0.73, 0.73), "CornellRed": (0.62, 0.065, 0.05),
    "CornellGreen": (0.14, 0.46, 0.09),
    # woods, metals, plastics, cloth
    "Oak": (0.46, 0.31, 0.17), "Walnut": (0.20, 0.115, 0.065), "Birch": (0.58, 0.45, 0.30),
    "Steel": (0.45, 0.46, 0.47), "DarkSteel": (0.11, 0.115, 0.12), "Brass": (0.46, 0.33, 0.12),
    "WhiteMetal": (0.76, 0.76, 0.75), "BlackPlastic": (0.035, 0.035, 0.038),
    "GreyPlastic": (0.33, 0.34, 0.35), "WhitePlastic": (0.72, 0.72, 0.70),
    "TealCloth": (0.05, 0.20, 0.21), "RustCloth": (0.47, 0.15, 0.06),
    "MustardCloth": (0.56, 0.36, 0.07), "RugCream": (0.56, 0.50, 0.40),
    "RugRed": (0.38, 0.09, 0.07), "Terracotta": (0.48, 0.20, 0.11), "Soil": (0.06, 0.04, 0.03),
    "Leaf": (0.07, 0.22, 0.05), "LeafPale": (0.20, 0.34, 0.10), "Stem": (0.16, 0.15, 0.06),
    # paper, books, china
    "Paper": (0.77, 0.76, 0.72), "Kraft": (0.42, 0.30, 0.18), "Ink": (0.04, 0.045, 0.06),
    "Cork": (0.40, 0.25, 0.13), "BookRed": (0.42, 0.06, 0.05), "BookBlue": (0.06, 0.12, 0.32),
    "BookGreen": (0.08, 0.22, 0.12), "BookOchre": (0.52, 0.34, 0.09),
    "BookCream": (0.66, 0.60, 0.48), "BookGrey": (0.20, 0.21, 0.23),
    "ChinaWhite": (0.78, 0.77, 0.74), "ChinaBlue": (0.10, 0.24, 0.48),
    "Coffee": (0.035, 0.02, 0.012), "Ocean": (0.08, 0.22, 0.42), "Screen": (0.02, 0.02, 0.022),
    # pictures and sculpture
    "PaintRed": (0.56, 0.09, 0.06), "PaintBlue": (0.06, 0.14, 0.42),
    "PaintYellow": (0.70, 0.52, 0.08), "PaintBlack": (0.04, 0.04, 0.045),
    "PaintWhite": (0.76, 0.74, 0.69), "PaintTeal": (0.10, 0.36, 0.36),
    "PaintPink": (0.68, 0.36, 0.32), "PaintSand": (0.60, 0.48, 0.32), "Marble": (0.74, 0.72, 0.68),
    "Bronze": (0.26, 0.16, 0.07), "Clay": (0.50, 0.25, 0.15), "Granite": (0.27, 0.27, 0.29),
    "Jade": (0.20, 0.42, 0.28), "Basalt": (0.12, 0.12, 0.125), "Plinth": (0.76, 0.75, 0.73),
    "BenchOak": (0.42, 0.28, 0.15),
}

# Luminance in nits, white averaged with dark windows: monitors turned down for the evening.
LUMINANCE = {
    "ScreenGlow": (52.0, 68.0, 84.0),
    "ScreenGlowDim": (36.0, 48.0, 60.0),
}
