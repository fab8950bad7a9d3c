// gui.cpp - text and controls over the picture, by Dear ImGui.
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_freetype.h>
#include <imgui_internal.h> // for what lies under the pointer

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

extern "C" { // below the headers of the system, which do not bear it
#include "app/font.h"
#include "app/gui.h"
}

namespace
{
constexpr float TEXT_UNITS = 15; // height of a text on a screen of ordinary resolution
constexpr int STRIP_FLAGS = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                            ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings |
                            ImGuiWindowFlags_NoFocusOnAppearing |
                            ImGuiWindowFlags_NoBringToFrontOnFocus;

GLFWwindow *window;
float built_for; // the scale of the fonts

// What the fonts of the desktop have of these; as OpenSCAD's messages may quote any of them.
const ImWchar RANGES[] = {0x0020, 0x024F, // Latin
                          0x0250, 0x036F, // phonetic, combining
                          0x0370, 0x052F, // Greek, Cyrillic
                          0x0531, 0x05F4, // Armenian, Hebrew
                          0x1E00, 0x1FFF, // Latin, Greek
                          0x2000, 0x22FF, // marks, currencies, arrows, mathematics
                          0x2500, 0x266F, // lines, shapes
                          0xFFFD, 0xFFFD, 0};

const ImVec4 TONES[] = {{1.00f, 1.00f, 1.00f, 1},
                        {0.66f, 0.66f, 0.68f, 1},
                        {0.55f, 0.80f, 1.00f, 1},
                        {1.00f, 0.82f, 0.35f, 1},
                        {1.00f, 0.48f, 0.42f, 1}};

// Size of things as the desktop wants it, in pixels.
float wanted_scale()
{
    float scale, unused;
    glfwGetWindowContentScale(window, &scale, &unused);
    return scale > 0.5f ? scale : 1;
}

void build_fonts(float scale)
{
    ImGuiIO &io = ImGui::GetIO();
    io.Fonts->Clear();
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    io.Fonts->Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
    void *data;
    int size;
    // Fonts that the library cannot read end the program: font_read gives only those it can.
    if (font_read(&data, &size)) {
        io.Fonts->AddFontFromMemoryTTF(data, size, TEXT_UNITS * scale, nullptr, RANGES);
        io.Fonts->Build();
        io.Fonts->ClearInputData(); // frees the data, too
    } else {
        ImFontConfig config;
        config.SizePixels = 13 * scale;
        io.Fonts->AddFontDefault(&config);
        io.Fonts->Build();
    }
    io.FontGlobalScale = 1 / gui_density();
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.Colors[ImGuiCol_WindowBg].w = 0.92f;
    style.WindowRounding = style.FrameRounding = 3;
    style.WindowBorderSize = 0;
    style.ScaleAllSizes(scale / gui_density());
    ImGui::GetStyle() = style;
    built_for = scale;
}
} // namespace

void gui_start(struct GLFWwindow *handle)
{
    window = handle;
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigInputTextCursorBlink = false; // nothing is painted while nothing happens
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NoMouseCursorChange;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    build_fonts(wanted_scale());
}

void gui_stop(void)
{
    if (!window)
        return;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    window = nullptr;
}

void gui_begin(void)
{
    if (built_for != wanted_scale()) {
        build_fonts(wanted_scale());
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void gui_end(void)
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool gui_is_over(double x, double y)
{
    ImVec2 at(static_cast<float>(x), static_cast<float>(y));
    for (const ImGuiWindow *w : ImGui::GetCurrentContext()->Windows)
        if (w->WasActive && !w->Hidden && !(w->Flags & ImGuiWindowFlags_NoMouseInputs) &&
            w->Rect().Contains(at))
            return true;
    return false;
}

bool gui_is_typed_into(void)
{
    return ImGui::GetIO().WantTextInput;
}

bool gui_is_steered(void)
{
    return ImGui::GetIO().NavActive && ImGui::GetIO().NavVisible;
}

float gui_density(void)
{
    int width, height, frame_width, frame_height;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &frame_width, &frame_height);
    return width > 0 ? static_cast<float>(frame_width) / static_cast<float>(width) : 1;
}

float gui_em(void)
{
    const ImGuiIO &io = ImGui::GetIO(); // also before the first frame
    return io.Fonts->Fonts[0]->FontSize * io.FontGlobalScale;
}

float gui_strip(void)
{
    return gui_em() + 2 * ImGui::GetStyle().FramePadding.y;
}

struct gui_box gui_window_size(void)
{
    int width, height;
    glfwGetWindowSize(window, &width, &height);
    return {0, 0, static_cast<float>(width), static_cast<float>(height)};
}

bool gui_window(const char *title, enum gui_frame frame, const struct gui_box *box, bool *open)
{
    ImVec2 at(box->x, box->y), size(box->width, box->height);
    int flags = ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse;
    if (frame == GUI_STRIP) {
        const ImGuiStyle &style = ImGui::GetStyle();
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, style.FramePadding);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
        ImGui::SetNextWindowPos(at);
        ImGui::SetNextWindowSize(size);
        bool shown = ImGui::Begin(title, nullptr, STRIP_FLAGS);
        ImGui::PopStyleVar(3);
        return shown;
    }
    if (frame == GUI_DOCK) {
        ImGui::SetNextWindowPos(at);
        ImGui::SetNextWindowSize(size);
        flags |= ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                 ImGuiWindowFlags_NoFocusOnAppearing;
    } else {
        ImGui::SetNextWindowPos(ImVec2(at.x + size.x / 2, at.y + size.y / 2), ImGuiCond_Always,
                                ImVec2(0.5f, 0.5f));
        ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), size);
        flags |= ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                 ImGuiWindowFlags_NoFocusOnAppearing;
    }
    return ImGui::Begin(title, open, flags);
}

void gui_window_end(void)
{
    ImGui::End();
}

void gui_text(enum gui_tone tone, const char *utf8)
{
    ImGui::PushStyleColor(ImGuiCol_Text, TONES[tone]);
    ImGui::TextUnformatted(utf8);
    ImGui::PopStyleColor();
}

void gui_wrapped(enum gui_tone tone, const char *utf8)
{
    ImGui::PushTextWrapPos(0);
    gui_text(tone, utf8);
    ImGui::PopTextWrapPos();
}

float gui_text_width(const char *utf8)
{
    return ImGui::CalcTextSize(utf8).x;
}

void gui_gap(void)
{
    ImGui::Dummy(ImVec2(0, gui_em() / 2));
}

void gui_beside(float x)
{
    ImGui::SameLine(x);
}

void gui_hint(const char *utf8)
{
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", utf8);
}

bool gui_row(enum gui_tone tone, const char *utf8)
{
    ImGui::PushID(utf8);
    ImVec2 at = ImGui::GetCursorPos();
    float width = ImGui::GetContentRegionAvail().x;
    ImVec2 size = ImGui::CalcTextSize(utf8, nullptr, false, width);
    bool clicked = ImGui::Selectable("##row", false, 0, ImVec2(width, size.y));
    ImVec2 next = ImGui::GetCursorPos();
    ImGui::SetCursorPos(at);
    gui_wrapped(tone, utf8);
    ImGui::SetCursorPos(next);
    ImGui::PopID();
    return clicked;
}

void gui_scope_begin(unsigned number)
{
    ImGui::PushID(static_cast<int>(number));
}

void gui_scope_end(void)
{
    ImGui::PopID();
}

void gui_group_begin(void)
{
    ImGui::BeginGroup();
}

void gui_group_end(void)
{
    ImGui::EndGroup();
}

bool gui_check(const char *label, bool *value)
{
    return ImGui::Checkbox(label, value);
}

bool gui_number(const char *label, double *value, double step)
{
    return ImGui::InputDouble(label, value, step, 10 * step, "%.10g");
}

bool gui_slider(const char *label, double *value, double min, double max)
{
    return ImGui::SliderScalar(label, ImGuiDataType_Double, value, &min, &max, "%.10g");
}

bool gui_input(const char *label, const char *hint, char *text, size_t size)
{
    return ImGui::InputTextWithHint(label, hint, text, size);
}

bool gui_button(const char *label)
{
    return ImGui::Button(label);
}

bool gui_small_button(const char *label)
{
    return ImGui::SmallButton(label);
}

bool gui_section(const char *label)
{
    return ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_DefaultOpen);
}

void gui_fill_width(float but)
{
    ImGui::SetNextItemWidth(but > 0 ? -but : -1);
}

bool gui_choices_begin(const char *label, const char *shown)
{
    return ImGui::BeginCombo(label, shown, ImGuiComboFlags_HeightLarge);
}

bool gui_choice(const char *label, bool chosen)
{
    bool taken = ImGui::Selectable(label, chosen);
    if (chosen && ImGui::IsWindowAppearing())
        ImGui::SetScrollHereY();
    return taken && !chosen;
}

void gui_choices_end(void)
{
    ImGui::EndCombo();
}

void gui_copy(const char *utf8)
{
    ImGui::SetClipboardText(utf8);
}

const char *gui_pasted(void)
{
    const char *text = ImGui::GetClipboardText();
    return text ? text : "";
}
