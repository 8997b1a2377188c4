; check --set channel.spindel[0].plc_control=1: exit 1
; warning K-0075 at --set 1:1
; error 21202 at 5:13
S[M3 REV100]
S[M3 REV200 G130=50]
M30
