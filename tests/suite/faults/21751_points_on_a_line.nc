; check: exit 1
; error 21751 at 3:1
G303 I10 X20 F1000
M30
