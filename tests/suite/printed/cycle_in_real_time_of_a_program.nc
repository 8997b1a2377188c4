; check: exit 1
; page 444678923 cycle in real time, as long as the program
; error K-0019 at 4:1
#RT CYCLE [SCOPE = PROG]
  M8
#RT CYCLE END
G00 X100
M30
