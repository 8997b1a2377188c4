; check: exit 1
; error 20109 at 4:5
; warning K-0100 at 4:1
G08 G193
M30
