; check: exit 1
; error 20847 at 21:7
; error 20847 at 22:7
; error 20847 at 23:7
; error 20847 at 24:7
; error 20847 at 25:7
; error 20847 at 26:7
(SGNn holds -2^(n-1) to 2^(n-1) - 1, UNSn 0 to 2^n - 1: both ends of each, then one more)
#VAR
V.P.A : SGN08
V.P.B : SGN16
V.P.C : SGN32
V.P.D : UNS08
V.P.E : UNS16
V.P.F : UNS32
#ENDVAR
V.P.A=-128 V.P.B=-32768 V.P.C=-2147483648
V.P.D=0 V.P.E=0 V.P.F=0
V.P.A=127 V.P.B=32767 V.P.C=2147483647
V.P.D=255 V.P.E=65535 V.P.F=4294967295
V.P.A=128
V.P.B=32768
V.P.C=2147483648
V.P.D=256
V.P.E=65536
V.P.F=4294967296
M30
