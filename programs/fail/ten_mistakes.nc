; Ten mistakes of different kinds; kontur check names all of them in one run.
%TEN_MISTAKES
N10 G71 G90 G17 G54
N20 G01 X10                  ; no feed yet: 20008
N30 F2000
N40 G777                     ; no such G function: 20131
N50 #CONTUR MODE ON          ; no such command: 20509
N60 X1 Y2 X3                 ; one axis twice: 20203
N70 X[2*[P1+3]               ; a bracket is not closed: K-0002
N80 Y P9                     ; never assigned: 20925
N90 G02 X9 I5 R5             ; centre and radius: 21024
N100 LL CORNER               ; no such subroutine: K-0014
N110 #VIB GUARD ON [MODE=9]  ; modes are 1 to 4: 22062
N120 G01 X1 {                ; not a character of the language: K-0001
N130 M30
