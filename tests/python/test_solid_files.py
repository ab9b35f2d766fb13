# SPDX-License-Identifier: GPL-3.0-or-later
# Solid.read takes the files that the command line takes.
import math

import phongpd
import pytest

BOX = ("<collision><geometry><box size='1 2 3'/></geometry></collision>")
ROBOT = (
    "<robot name='r'><link name='base'>" + BOX + "</link><link name='arm'>" + BOX
    + "</link><joint name='lift' type='prismatic'><parent link='base'/>"
    "<child link='arm'/><axis xyz='1 0 0'/><limit lower='0' upper='5'/></joint>"
    "</robot>")


@pytest.fixture
def robot_file(tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text(ROBOT)
    try:
        phongpd.Solid.read(f"{path}#arm")
    except phongpd.InputError as error:
        # A build without the libraries says so, in one line that helps.
        assert "without Assimp" in str(error) and "\n" not in str(error)
        assert "STL" in str(error)
        pytest.skip("built without Assimp and tinyxml2")
    return path


def test_reads_a_link_and_tells_what_to_know(robot_file):
    arm = phongpd.Solid.read(f"{robot_file}#arm")
    assert arm.volume == pytest.approx(6.0)
    assert arm.name == f"{robot_file}#arm"
    assert any("metres" in line for line in arm.warnings)


def test_reads_a_robot_at_its_joint_values(robot_file):
    robot = phongpd.Solid.read(f"{robot_file}@lift=4", name="robot")
    assert robot.name == "robot"
    assert robot.components == 2
    assert robot.vertices[:, 0].min() == pytest.approx(-0.5)
    assert robot.vertices[:, 0].max() == pytest.approx(4.5)


def test_reads_gltf_in_single_precision(robot_file, tmp_path):
    # A tetrahedron; of its coordinates floats keep seven digits.
    import base64
    import json
    import struct
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1.00000001)]
    corners = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
    data = (struct.pack("<12f", *[x for p in points for x in p])
            + struct.pack("<12I", *corners))
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    (tmp_path / "t.gltf").write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
                                    "indices": 1}]}],
        "buffers": [{"uri": uri, "byteLength": len(data)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 48}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
             "min": [0, 0, 0], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5125, "count": 12,
             "type": "SCALAR"}]}))
    solid = phongpd.Solid.read(tmp_path / "t.gltf")
    assert solid.volume == pytest.approx(1 / 6, rel=1e-7)
    assert any("single precision" in line for line in solid.warnings)
    assert math.isclose(solid.vertices[:, 2].max(), 1.0, abs_tol=0)


def test_refuses_in_one_line(robot_file, tmp_path):
    for name, words in ((f"{robot_file}", "no link's name"),
                        (f"{robot_file}@lift=6", r"in \[0, 5\] m, found 6"),
                        (tmp_path / "none.glb", "none.glb")):
        with pytest.raises(phongpd.InputError, match=words) as error:
            phongpd.Solid.read(name)
        assert "\n" not in str(error.value)


def test_words_of_files_that_are_no_utf_8_are_told(robot_file, tmp_path):
    path = tmp_path / "t.dae"
    path.write_bytes(
        b"<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
        b"version='1.4.1'><asset><up_axis>\xffUP</up_axis></asset>"
        b"<library_geometries><geometry id='g'><mesh><source id='p'>"
        b"<float_array id='a' count='12'>0 0 0 1 0 0 0 1 0 0 0 1</float_array>"
        b"<technique_common><accessor source='#a' count='4' stride='3'>"
        b"<param name='X' type='float'/><param name='Y' type='float'/>"
        b"<param name='Z' type='float'/></accessor></technique_common></source>"
        b"<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
        b"<triangles count='4'><input semantic='VERTEX' source='#v' offset='0'/>"
        b"<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry>"
        b"</library_geometries><library_visual_scenes><visual_scene id='s'>"
        b"<node id='n'><instance_geometry url='#g'/></node></visual_scene>"
        b"</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
        b"</COLLADA>")
    solid = phongpd.Solid.read(path)
    assert any("?UP" in line for line in solid.warnings)
