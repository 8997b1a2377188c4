; run --set channel.m_default_outp_ax_name[7]=Z: exit 0
; page 15319584523 M function that goes to an axis of the list, and to another one
; end X25 Y0 Z0
N20 X75 F5000
N30 X50
N40 X25 M7
N50 X[M7]
N60 M30
