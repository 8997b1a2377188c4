; run: exit 0
; end X11
; note K-0109 at 19:1
#FILE NAME [G80="called/one_more.nc" M6="called/one_more.nc"]
(a subroutine: G91 stays)
G80
X1
(a cycle: G91 is undone)
G90 X3
G80 [1]
X5
(the call comes before the end of the level: X6)
LL A
P2=1
RP2=5
(the modal cycle runs here, after the last motion, and after the motion of the tool change)
L CYCLE [NAME="called/one_more.nc" MODAL_MOVE]
G90 X8 M6 M30
%L A
G80 M17
