; check: exit 1
; page 793352331 real-time loop with tool radius compensation
; warning K-0114 at 5:1
; error 22158 at 6:1
G41 G01 X5 F500
#RT WHILE
M30
