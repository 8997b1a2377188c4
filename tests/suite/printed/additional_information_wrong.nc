; check: exit 1
; page 15556955787 words after #ADD, wrong
; error 21509 at 5:28
N10 G00 X0 Y0 Z0
N50 Z33 #ADD["Z-position"] X11 Y22
N999 M30
