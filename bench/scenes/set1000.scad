// Set of 1000: copies of an expression of ten primitives in which every primitive counts for
// itself, nested as deep as they are many. As many distinct values as primitives.
//
// Primitives: 10 * copies (1000 by default).

/* [Scene] */
// Copies of the expression
copies = 100; // [1:1:1000]
// Facets around each sphere
fn = 12; // [8:1:128]
// Edge of the region that holds the centres of the copies
size = 100; // [10:1:1000]
// Distance of a primitive from the middle of its copy, at most, as a fraction of the region
jitter = 0.1; // [0:0.01:0.5]
// Random seed
seed = 1; // [1:1:1000]

/* [Hidden] */
function lcg(s) = (s * 16807) % 2147483647;
function rnd(count, s) = [for (i = 0, v = lcg(lcg(lcg(s + 56789))); i < count; i = i + 1, v = lcg(v)) v / 2147483647];

u = rnd(33 * copies, seed);
$fn = fn;

// Primitive number j of copy i: around the middle of the copy, so that all of them meet.
module p(i, j, r) {
  b = 33 * i + 3 * (j + 1);
  translate([for (a = [0 : 2]) (u[b + a] - 0.5) * jitter * size])
    if (j % 3 == 2) cube(1.5 * r * size, center = true);
    else sphere(r = r * size);
}

module copy(i) {
  difference() {
    p(i, 0, 0.12);
    intersection() {
      p(i, 1, 0.10);
      union() {
        p(i, 2, 0.06);
        intersection() {
          p(i, 3, 0.10);
          union() {
            p(i, 4, 0.06);
            intersection() {
              p(i, 5, 0.09);
              union() {
                p(i, 6, 0.05);
                difference() {
                  p(i, 7, 0.08);
                  difference() {
                    p(i, 8, 0.07);
                    p(i, 9, 0.04);
                  }
                }
              }
            }
          }
        }
      }
    }
  }
}

for (i = [0 : copies - 1])
  translate([for (a = [0 : 2]) (u[33 * i + a] - 0.5) * size]) copy(i);
