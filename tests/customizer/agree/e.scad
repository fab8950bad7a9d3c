//first
x=1; // 1
//second
x=2; // 2
/* [G] */
//y first
y=1; // 3
y=2;
z=1; // 4
z=2+1;
w=2+1;
//w desc
w=5; // 4
v=1; // 9
module foo(a=1, b=2) cube(a); // 5
function f(q=1)=q;
k=4; // 7
if (true) cube(3); else sphere(2);
use <foo.scad>
k2=5; // 8
cube(kk=1);
k3=5; translate([1,2,3]) cube(k4=1); // 8
assign(k5=1) cube(k5);
;;;
k6=[for(i=0;i<3;i=i+1) i]; // 8
k7=1; // 8
$fa=3; // 4
k8=assert(true) 1; // 2
!cube(1); %cube(2); #cube(3); *cube(4);
k9=-
 1; // 5
t=2; module m() { cube(); } l1=1; // 4
l2=1; // 4
v=2;
