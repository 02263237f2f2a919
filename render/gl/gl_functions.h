// The OpenGL 3.3 core entry points that billow calls, as a table: no packaged loader works with OSMesa.
#pragma once

#include <GL/glcorearb.h>

namespace billow::render {

// clang-format off
#define BILLOW_GL_FUNCTIONS(X)                                                \
  X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                    \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                      \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                          \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                \
  X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                              \
  X(PFNGLBINDTEXTUREPROC, BindTexture)                                        \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                \
  X(PFNGLBLENDFUNCPROC, BlendFunc)                                            \
  X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                            \
  X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                                \
  X(PFNGLBUFFERDATAPROC, BufferData)                                          \
  X(PFNGLBUFFERSUBDATAPROC, BufferSubData)                                    \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                  \
  X(PFNGLCLEARPROC, Clear)                                                    \
  X(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                                  \
  X(PFNGLCLEARCOLORPROC, ClearColor)                                          \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                                    \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                    \
  X(PFNGLCREATESHADERPROC, CreateShader)                                      \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                    \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                          \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                    \
  X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                        \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                      \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                  \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                          \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                            \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                            \
  X(PFNGLDISABLEPROC, Disable)                                                \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                          \
  X(PFNGLDRAWBUFFERPROC, DrawBuffer)                                          \
  X(PFNGLDRAWBUFFERSPROC, DrawBuffers)                                        \
  X(PFNGLDRAWELEMENTSPROC, DrawElements)                                      \
  X(PFNGLENABLEPROC, Enable)                                                  \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                \
  X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)                \
  X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                      \
  X(PFNGLGENBUFFERSPROC, GenBuffers)                                          \
  X(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)                                  \
  X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                \
  X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                              \
  X(PFNGLGENTEXTURESPROC, GenTextures)                                        \
  X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                \
  X(PFNGLGETERRORPROC, GetError)                                              \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                        \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                      \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                              \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                        \
  X(PFNGLGETSTRINGPROC, GetString)                                            \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                          \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                        \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                        \
  X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                                    \
  X(PFNGLREADBUFFERPROC, ReadBuffer)                                          \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                          \
  X(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample)  \
  X(PFNGLSCISSORPROC, Scissor)                                                \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                      \
  X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                          \
  X(PFNGLTEXPARAMETERFVPROC, TexParameterfv)                                  \
  X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                    \
  X(PFNGLUNIFORM1FPROC, Uniform1f)                                            \
  X(PFNGLUNIFORM1IPROC, Uniform1i)                                            \
  X(PFNGLUNIFORM2FVPROC, Uniform2fv)                                          \
  X(PFNGLUNIFORM3FVPROC, Uniform3fv)                                          \
  X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                              \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                          \
  X(PFNGLVERTEXATTRIB3FPROC, VertexAttrib3f)                                  \
  X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                        \
  X(PFNGLVIEWPORTPROC, Viewport)
// clang-format on

/// One pointer per entry point, all of them valid: gl.DrawArrays(...) is glDrawArrays(...).
struct Gl {
#define BILLOW_GL_MEMBER(type, name) type name = nullptr;
  BILLOW_GL_FUNCTIONS(BILLOW_GL_MEMBER)
#undef BILLOW_GL_MEMBER
};

}  // namespace billow::render
