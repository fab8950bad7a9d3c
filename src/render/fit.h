// fit.h - the camera moved and its distance chosen so that what shows fills the picture.
#pragma once
#include "render/camera.h"
#include "render/device.h"

// Keeps rotation, projection and angle of view. Between what shows and the borders of the picture
// `margin` pixels stay free, on two opposite sides no more than that; on the others it is centred.
// It stays as it is where nothing shows.
void camera_fit(struct camera *c, int width, int height, double margin, struct device *device,
                const struct model *model, const struct render_settings *settings);
