; run: exit 1
; error 21391 at 3:1
#OTC ON
M30
