import * as THREE from 'three';
import { t } from '@/i18n';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { selfContained, type Beside } from './gltf';

/**
 * Reads a mesh file into one geometry, in the file's own units and axes, as the simulator does.
 *
 * @param beside Reads a file that the mesh names, which only glTF does for its shape.
 * @throws Error with a text for users if the mesh cannot be used
 */
export async function readMesh(
  path: string,
  data: ArrayBuffer,
  beside: Beside = (name) => Promise.reject(new Error(name)),
): Promise<THREE.BufferGeometry> {
  const mesh = await parsed(path, data, beside);
  const corners = mesh.getAttribute('position').array;
  if (corners.length === 0) throw new Error(t('editor3d:mesh.empty'));
  if (!corners.every(Number.isFinite)) throw new Error(t('editor3d:mesh.corners'));
  return mesh;
}

async function parsed(path: string, data: ArrayBuffer, beside: Beside): Promise<THREE.BufferGeometry> {
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
      const scene = new ColladaLoader().parse(withoutLooks(text()), '')?.scene;
      if (!scene) throw new Error(t('editor3d:mesh.empty'));
      // The unit is applied and the axes stay, as in the simulator and in RViz.
      scene.rotation.set(0, 0, 0);
      return merged(scene);
    }
    case 'glb': {
      const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
      return merged((await new GLTFLoader().parseAsync(data, '')).scene);
    }
    case 'gltf': {
      const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
      const { document, buffers } = await selfContained(text(), beside);
      const loader = new GLTFLoader().register((parser) => {
        parser.loadBuffer = (index) => {
          const buffer = buffers[index];
          return buffer ? Promise.resolve(buffer) : Promise.reject(new Error(`no buffer ${index}`));
        };
        return { name: 'buffers' };
      });
      return merged((await loader.parseAsync(document, '')).scene);
    }
    default:
      throw new Error(t('editor3d:mesh.kind', { kind: kind ?? '' }));
  }
}

/**
 * Returns a COLLADA file without its pictures, which would be fetched for nothing, and without its axis, of which
 * the reader would warn in the console.
 */
function withoutLooks(text: string): string {
  return text
    .replace(/<library_images\b[^>]*>[^]*?<\/library_images>/g, '')
    .replace(/<texture\b[^>]*\/>|<texture\b[^>]*>[^]*?<\/texture>/g, '<color>1 1 1 1</color>')
    .replace(/<up_axis>[^<]*<\/up_axis>/g, '');
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
