// opencsg_c.cpp - OpenCSG's C++ interface, for C.
#include "opencsg_c.h"

#include <memory>
#include <opencsg.h>
#include <vector>

namespace
{

class leaf_primitive : public OpenCSG::Primitive
{
  public:
    leaf_primitive(OpenCSG::Operation operation, unsigned convexity, uint32_t leaf,
                   void (*draw)(void *, uint32_t), void *context)
        : Primitive(operation, convexity), leaf_(leaf), draw_(draw), context_(context)
    {
    }
    void render() override
    {
        draw_(context_, leaf_);
    }

  private:
    uint32_t leaf_;
    void (*draw_)(void *, uint32_t);
    void *context_;
};

} // namespace

struct opencsg_product {
    std::vector<std::unique_ptr<leaf_primitive>> owned;
    std::vector<OpenCSG::Primitive *> primitives;
};

void opencsg_choose(enum opencsg_algorithm algorithm)
{
    OpenCSG::setOption(OpenCSG::OffscreenSetting, OpenCSG::FrameBufferObject);
    OpenCSG::setOption(OpenCSG::AlgorithmSetting, algorithm == OPENCSG_SCS ? OpenCSG::SCS
                                                  : algorithm == OPENCSG_GOLDFEATHER
                                                      ? OpenCSG::Goldfeather
                                                      : OpenCSG::Automatic);
    // Automatic looks at the number of primitives itself; queries are what the other two gain by.
    OpenCSG::setOption(OpenCSG::DepthComplexitySetting, algorithm == OPENCSG_AUTOMATIC
                                                            ? OpenCSG::NoDepthComplexitySampling
                                                            : OpenCSG::OcclusionQuery);
}

struct opencsg_product *opencsg_product_new(const uint32_t *leaves, uint32_t intersected,
                                            uint32_t count, uint32_t convexity,
                                            void (*draw)(void *context, uint32_t leaf),
                                            void *context)
{
    auto p = std::make_unique<opencsg_product>();
    for (uint32_t i = 0; i < count; i++) {
        auto operation = i < intersected ? OpenCSG::Intersection : OpenCSG::Subtraction;
        p->owned.push_back(
            std::make_unique<leaf_primitive>(operation, convexity, leaves[i], draw, context));
        p->primitives.push_back(p->owned.back().get());
    }
    return p.release();
}

void opencsg_product_delete(struct opencsg_product *p)
{
    delete p;
}

void opencsg_product_box(struct opencsg_product *p, uint32_t i, const float box[6])
{
    p->primitives[i]->setBoundingBox(box[0], box[1], box[2], box[3], box[4], box[5]);
}

void opencsg_render(const struct opencsg_product *p)
{
    OpenCSG::render(p->primitives);
}
