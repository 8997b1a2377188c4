; check: exit 1
; error 3210 at 4:13
; the list of X has one gear stage only
N10 G112 X1 Y4
N20 M30
