; check: exit 1
; error 20129 at 4:6
; warning K-0111 at 4:1
G200 G201
M30
