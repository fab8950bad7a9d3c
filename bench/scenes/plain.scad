// Plain: one cube. A frame in which nothing is to be decided, the floor for the other scenes.

// Edge
size = 100; // [1:1:1000]

cube(size, center = true);
