; check: exit 1
; page 444693771 expressions in a cycle in real time
; error K-0019 at 4:1
#RT CYCLE [SCOPE = PROG]
  IF SQRT[7 * 5] < 12 * SIN[30]
  $ENDIF
  V.E.VALUE1 = 12 * SIN[V.E.VALUE2] + SQRT[33]
#RT CYCLE END
M30
