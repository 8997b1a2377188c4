; check: exit 1
; error 22181 at 4:1
G01 X0 F1000
#RT ENDWHILE
M30
