#pragma once

#include <GL/glcorearb.h>

#include <functional>
#include <string_view>

namespace alula::render::internal {

// Every GL function that the room calls: the name without "gl", and the same in capitals as glcorearb.h types it.
#define ALULA_GL_FUNCTIONS(F)                         \
  F(ActiveTexture, ACTIVETEXTURE)                     \
  F(AttachShader, ATTACHSHADER)                       \
  F(BindBuffer, BINDBUFFER)                           \
  F(BindFramebuffer, BINDFRAMEBUFFER)                 \
  F(BindRenderbuffer, BINDRENDERBUFFER)               \
  F(BindTexture, BINDTEXTURE)                         \
  F(BindVertexArray, BINDVERTEXARRAY)                 \
  F(BlitFramebuffer, BLITFRAMEBUFFER)                 \
  F(BufferData, BUFFERDATA)                           \
  F(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)   \
  F(Clear, CLEAR)                                     \
  F(ClearColor, CLEARCOLOR)                           \
  F(CompileShader, COMPILESHADER)                     \
  F(CreateProgram, CREATEPROGRAM)                     \
  F(CreateShader, CREATESHADER)                       \
  F(CullFace, CULLFACE)                               \
  F(DeleteFramebuffers, DELETEFRAMEBUFFERS)           \
  F(DeleteShader, DELETESHADER)                       \
  F(DepthFunc, DEPTHFUNC)                             \
  F(DepthMask, DEPTHMASK)                             \
  F(Disable, DISABLE)                                 \
  F(DrawArrays, DRAWARRAYS)                           \
  F(DrawBuffer, DRAWBUFFER)                           \
  F(DrawElements, DRAWELEMENTS)                       \
  F(Enable, ENABLE)                                   \
  F(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY) \
  F(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER) \
  F(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)       \
  F(FrontFace, FRONTFACE)                             \
  F(GenBuffers, GENBUFFERS)                           \
  F(GenFramebuffers, GENFRAMEBUFFERS)                 \
  F(GenRenderbuffers, GENRENDERBUFFERS)               \
  F(GenTextures, GENTEXTURES)                         \
  F(GenVertexArrays, GENVERTEXARRAYS)                 \
  F(GetError, GETERROR)                               \
  F(GetIntegerv, GETINTEGERV)                         \
  F(GetProgramInfoLog, GETPROGRAMINFOLOG)             \
  F(GetProgramiv, GETPROGRAMIV)                       \
  F(GetShaderInfoLog, GETSHADERINFOLOG)               \
  F(GetShaderiv, GETSHADERIV)                         \
  F(GetString, GETSTRING)                             \
  F(GetUniformLocation, GETUNIFORMLOCATION)           \
  F(LinkProgram, LINKPROGRAM)                         \
  F(MultiDrawElements, MULTIDRAWELEMENTS)             \
  F(PixelStorei, PIXELSTOREI)                         \
  F(PolygonOffset, POLYGONOFFSET)                     \
  F(ReadBuffer, READBUFFER)                           \
  F(ReadPixels, READPIXELS)                           \
  F(RenderbufferStorage, RENDERBUFFERSTORAGE)         \
  F(Scissor, SCISSOR)                                 \
  F(ShaderSource, SHADERSOURCE)                       \
  F(TexImage2D, TEXIMAGE2D)                           \
  F(TexParameteri, TEXPARAMETERI)                     \
  F(Uniform1f, UNIFORM1F)                             \
  F(Uniform1i, UNIFORM1I)                             \
  F(Uniform3fv, UNIFORM3FV)                           \
  F(Uniform4fv, UNIFORM4FV)                           \
  F(UniformMatrix3fv, UNIFORMMATRIX3FV)               \
  F(UniformMatrix4fv, UNIFORMMATRIX4FV)               \
  F(UniformMatrix4x3fv, UNIFORMMATRIX4X3FV)           \
  F(UseProgram, USEPROGRAM)                           \
  F(VertexAttribPointer, VERTEXATTRIBPOINTER)         \
  F(Viewport, VIEWPORT)

/// GL 3.3 core as one context's own loader resolves it; two makers in one process have two tables.
struct GlFunctions {
#define ALULA_GL_MEMBER(name, capitals) PFNGL##capitals##PROC name = nullptr;
  ALULA_GL_FUNCTIONS(ALULA_GL_MEMBER)
#undef ALULA_GL_MEMBER
};

/// Resolves one GL function by its full name ("glClear"); null where it is not known.
using GlLoader = std::function<void*(const char*)>;

/// Fills the table. Throws base::InputError naming the first function that `maker` lacks.
GlFunctions LoadGlFunctions(const GlLoader& load, std::string_view maker);

}  // namespace alula::render::internal
