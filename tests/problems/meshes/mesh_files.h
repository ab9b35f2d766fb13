// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "problems/shapes/shapes.h"

// Mesh files in formats that the project only reads, byte by byte as their
// standards have them.
namespace phongpd::testing {

// Doubles that floats hold, so that single precision changes nothing.
inline TriangleMesh Block() {
  return MakeBox({-0.5, 0.25, -1.0}, {1.5, 0.75, 3.0});
}

template <typename T>
void Append(std::string* bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes->append(raw, sizeof(T));
}

inline std::string Spaced(const TriangleMesh& mesh) {
  std::string text;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) text += std::to_string(v[k]) + ' ';
  }
  return text;
}

// One geometry in one node that is moved by (2, 0, 0).
inline std::string Collada(const TriangleMesh& mesh, const std::string& asset) {
  std::string indices;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) indices += std::to_string(v) + ' ';
  }
  const std::string n = std::to_string(mesh.vertices.size());
  const std::string n3 = std::to_string(3 * mesh.vertices.size());
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         asset + R"(</asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="a" count=")" +
         n3 + "\">" + Spaced(mesh) + R"(</float_array><technique_common>
<accessor source="#a" count=")" +
         n + R"(" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count=")" +
         std::to_string(mesh.triangles.size()) +
         R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices +
         R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s" name="s">
<node id="n" name="n"><translate>2 0 0</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

// Positions, then indices.
inline std::string GltfBuffer(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) Append(&bytes, static_cast<float>(v[k]));
  }
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) Append(&bytes, static_cast<std::uint32_t>(v));
  }
  return bytes;
}

// The JSON of one mesh in one node that is moved by (2, 0, 0); `uri` is a
// member of the buffer, with its comma, or empty.
inline std::string GltfJson(const TriangleMesh& mesh, const std::string& uri) {
  const std::size_t points = mesh.vertices.size();
  const std::size_t corners = 3 * mesh.triangles.size();
  const auto text = [](std::size_t n) { return std::to_string(n); };
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"mesh":0,"translation":[2,0,0]}],"meshes":[{"primitives":)"
         R"([{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],"buffers":[{)" +
         uri + "\"byteLength\":" + text(12 * points + 4 * corners) +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" +
         text(12 * points) + R"(},{"buffer":0,"byteOffset":)" +
         text(12 * points) + ",\"byteLength\":" + text(4 * corners) +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
         text(points) +
         R"(,"type":"VEC3","min":[-9,-9,-9],"max":[9,9,9]},{"bufferView":1,)"
         R"("componentType":5125,"count":)" +
         text(corners) + R"(,"type":"SCALAR"}]})";
}

inline std::string Glb(const TriangleMesh& mesh) {
  std::string json = GltfJson(mesh, "");
  while (json.size() % 4 != 0) json += ' ';
  const std::string data = GltfBuffer(mesh);
  std::string bytes = "glTF";
  Append(&bytes, std::uint32_t{2});
  Append(&bytes,
         static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
  Append(&bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  Append(&bytes, static_cast<std::uint32_t>(data.size()));
  bytes += "BIN";
  bytes += '\0';
  return bytes + data;
}

inline std::uint32_t Crc(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

// A zip archive of stored files.
inline std::string Zip(
    const std::vector<std::pair<std::string, std::string>>& files) {
  std::string bytes, directory;
  for (const auto& [name, content] : files) {
    std::string common;  // of the local and the central header
    Append(&common, std::uint16_t{20});
    for (int k = 0; k < 4; ++k) Append(&common, std::uint16_t{0});
    Append(&common, Crc(content));
    for (int k = 0; k < 2; ++k) {
      Append(&common, static_cast<std::uint32_t>(content.size()));
    }
    Append(&common, static_cast<std::uint16_t>(name.size()));
    Append(&common, std::uint16_t{0});
    directory += "PK\x01\x02";
    Append(&directory, std::uint16_t{20});
    directory += common;
    for (int k = 0; k < 3; ++k) Append(&directory, std::uint16_t{0});
    Append(&directory, std::uint32_t{0});
    Append(&directory, static_cast<std::uint32_t>(bytes.size()));
    directory += name;
    bytes += "PK\x03\x04" + common + name + content;
  }
  const auto start = static_cast<std::uint32_t>(bytes.size());
  bytes += directory + "PK\x05\x06";
  Append(&bytes, std::uint32_t{0});
  for (int k = 0; k < 2; ++k) {
    Append(&bytes, static_cast<std::uint16_t>(files.size()));
  }
  Append(&bytes, static_cast<std::uint32_t>(directory.size()));
  Append(&bytes, start);
  Append(&bytes, std::uint16_t{0});
  return bytes;
}

// One object, built once, moved by (2, 0, 0).
inline std::string ThreeMf(const TriangleMesh& mesh) {
  std::string model =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?><model unit=\"millimeter\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">"
      "<resources><object id=\"1\" type=\"model\"><mesh><vertices>";
  for (const Eigen::Vector3d& v : mesh.vertices) {
    model += "<vertex x=\"" + std::to_string(v[0]) + "\" y=\"" +
             std::to_string(v[1]) + "\" z=\"" + std::to_string(v[2]) + "\"/>";
  }
  model += "</vertices><triangles>";
  for (const Triangle& t : mesh.triangles) {
    model += "<triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" +
             std::to_string(t[1]) + "\" v3=\"" + std::to_string(t[2]) + "\"/>";
  }
  model +=
      "</triangles></mesh></object></resources><build><item objectid=\"1\" "
      "transform=\"1 0 0 0 1 0 0 0 1 2 0 0\"/></build></model>";
  return Zip(
      {{"[Content_Types].xml",
        "<?xml version=\"1.0\"?><Types xmlns=\"http://schemas.openxmlformats."
        "org/package/2006/content-types\"><Default Extension=\"rels\" "
        "ContentType=\"application/vnd.openxmlformats-package.relationships+"
        "xml\"/><Default Extension=\"model\" ContentType=\"application/vnd."
        "ms-package.3dmanufacturing-3dmodel+xml\"/></Types>"},
       {"_rels/.rels",
        "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas."
        "openxmlformats.org/package/2006/relationships\"><Relationship "
        "Target=\"/3D/3dmodel.model\" Id=\"rel0\" Type=\"http://schemas."
        "microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
       {"3D/3dmodel.model", model}});
}

}  // namespace phongpd::testing
