; check: exit 1
; error K-0002 at 3:1
XOX F1000
M30
