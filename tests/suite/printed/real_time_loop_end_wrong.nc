; check: exit 1
; page 991397515 diagnosis 22181, wrong
; error 22181 at 5:1
G01 X0 F1000
#RT ENDWHILE
M30
