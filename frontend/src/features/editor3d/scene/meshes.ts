import * as THREE from 'three';
import { t } from '@/i18n';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

/**
 * Reads a mesh file into one geometry, in the file's own units and axes, as the simulator does.
 *
 * @throws Error with a text for users if the mesh cannot be used
 */
export async function readMesh(path: string, data: ArrayBuffer): Promise<THREE.BufferGeometry> {
  const mesh = await parsed(path, data);
  const corners = mesh.getAttribute('position').array;
  if (corners.length === 0) throw new Error(t('editor3d:mesh.empty'));
  if (!corners.every(Number.isFinite)) throw new Error(t('editor3d:mesh.corners'));
  return mesh;
}

async function parsed(path: string, data: ArrayBuffer): Promise<THREE.BufferGeometry> {
  const kind = /\.(\w+)$/.exec(path.toLowerCase())?.[1];
  const text = () => new TextDecoder().decode(data);
  switch (kind) {
    case 'stl': {
      const { STLLoader } = await import('three/examples/jsm/loaders/STLLoader.js');
      return plain(new STLLoader().parse(data));
    }
    case 'ply': {
      const { PLYLoader } = await import('three/examples/jsm/loaders/PLYLoader.js');
      return plain(new PLYLoader().parse(data));
    }
    case 'obj': {
      const { OBJLoader } = await import('three/examples/jsm/loaders/OBJLoader.js');
      return merged(new OBJLoader().parse(text()));
    }
    case 'dae': {
      const { ColladaLoader } = await import('three/examples/jsm/loaders/ColladaLoader.js');
      const scene = new ColladaLoader().parse(text(), '')?.scene;
      if (!scene) throw new Error(t('editor3d:mesh.empty'));
      // The file's own axes and units stay: the simulator also ignores the declared ones.
      scene.rotation.set(0, 0, 0);
      scene.scale.set(1, 1, 1);
      return merged(scene);
    }
    case 'glb': {
      const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
      return merged((await new GLTFLoader().parseAsync(data, '')).scene);
    }
    default:
      throw new Error(t('editor3d:mesh.kind', { kind: kind ?? '' }));
  }
}

function plain(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const bare = new THREE.BufferGeometry();
  bare.setAttribute('position', geometry.getAttribute('position'));
  const flat = geometry.index ? bare.setIndex(geometry.index).toNonIndexed() : bare;
  flat.computeVertexNormals();
  return flat;
}

function merged(root: THREE.Object3D): THREE.BufferGeometry {
  root.updateMatrixWorld(true);
  const parts: THREE.BufferGeometry[] = [];
  root.traverse((child) => {
    if (child instanceof THREE.Mesh) {
      parts.push(plain(child.geometry as THREE.BufferGeometry).applyMatrix4(child.matrixWorld));
    }
  });
  if (parts.length === 0) throw new Error(t('editor3d:mesh.empty'));
  return mergeGeometries(parts);
}
