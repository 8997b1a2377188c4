; check: exit 1
; page 252329867 diagnosis 20721, three formats and two values
; error 20721 at 4:11
N10 #MSG ["WERT1=%D WERT2=%D WERT3=%D", 1, 2]
N20 M30
