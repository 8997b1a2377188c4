; check: exit 1
; page 444684555 branches of a cycle in real time
; error K-0019 at 4:1
#RT CYCLE [SCOPE = PROG]
  $IF V.E.VALUE > 0
    V.E.COUNT_POS += 1
  $ELSEIF V.E.VALUE < 0
    V.E.COUNT_NEG += 1
  $ELSE
    V.E.COUNT_NULL += 1
  $ENDIF
#RT CYCLE END
M30
