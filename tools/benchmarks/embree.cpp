// Embree asked in C++, as fast as we know how: packets of 16 rays, of a camera's image 4x4 pixels, made
// here; all threads. tools/benchmarks/embree.py compiles this and calls it; EMBREE is 3 or 4.

#if EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int BLOCK = 64;      // pixels a side that a thread takes at once
constexpr float INF = std::numeric_limits<float>::infinity();

// As tools/benchmarks/embree.py writes it: a pixel's image point is left + (column + 0.5) dx, and so on.
// across = x u + y v; perspective: eye, across + forward; parallel: eye + across, forward.
struct Camera {
  float eye[3], u[3], v[3], forward[3], left, top, dx, dy;
  int width, height, parallel;
};

struct Image {  // normal: unit, three floats a pixel
  float* t;
  int* primitive;
  float* normal;
};

// Threads that sleep until all of them, the caller among them, are to run the same task.
class Team {
 public:
  explicit Team(int threads) {
    for (int k = 1; k < threads; ++k) workers_.emplace_back([this] { work(); });
  }

  ~Team() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      task_ = nullptr;
      ++round_;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  void run(const std::function<void()>& task) {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      task_ = &task;
      busy_ = workers_.size();
      ++round_;
    }
    wake_.notify_all();
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);  // denormal numbers are zero
    task();
    _mm_setcsr(before);
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void work() {
    _mm_setcsr(_mm_getcsr() | 0x8040);
    for (unsigned seen = 0;;) {
      const std::function<void()>* task;
      {
        std::unique_lock<std::mutex> lock(mutex_);
        wake_.wait(lock, [&] { return round_ != seen; });
        seen = round_;
        task = task_;
      }
      if (!task) return;
      (*task)();
      std::lock_guard<std::mutex> lock(mutex_);
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void()>* task_ = nullptr;
  size_t busy_ = 0;
  unsigned round_ = 0;
  std::vector<std::thread> workers_;
};

struct Embree {
  RTCDevice device;
  RTCScene scene;
  Team team;

  Embree(int threads)
      : device(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
        scene(rtcNewScene(device)),
        team(threads) {}
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  // Parts of `count`, `step` at a time, to whichever thread is free.
  template <class Part>
  void share(size_t count, size_t step, Part part) {
    std::atomic<size_t> next{0};
    team.run([&] {
      for (size_t begin; (begin = next.fetch_add(step)) < count;)
        part(begin, std::min(count, begin + step));
    });
  }
};

// How Embree is asked, 16 rays at a time.
struct Ask {
#if EMBREE == 4
  RTCIntersectArguments closest;

  Ask() {
    rtcInitIntersectArguments(&closest);
    closest.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  void trace(const int* valid, RTCScene scene, RTCRayHit16* rays) { rtcIntersect16(valid, scene, rays, &closest); }
#else
  RTCIntersectContext context;

  Ask() {
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void trace(const int* valid, RTCScene scene, RTCRayHit16* rays) { rtcIntersect16(valid, scene, &context, rays); }
#endif
};

// 16 rays: who sets org and dir, and which of them are valid (-1, or 0), may ask for their hits.
struct Packet {
  alignas(64) RTCRayHit16 rays;
  alignas(64) int valid[16];
  float *org[3] = {rays.ray.org_x, rays.ray.org_y, rays.ray.org_z};
  float *dir[3] = {rays.ray.dir_x, rays.ray.dir_y, rays.ray.dir_z};

  Packet() {
    std::memset(&rays, 0, sizeof rays);
    std::fill_n(rays.ray.mask, 16, ~0u);
  }

  void trace(Ask& ask, RTCScene scene) {
    for (int i = 0; i < 16; ++i) {
      rays.ray.tfar[i] = INF;
      rays.hit.geomID[i] = rays.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.Ng_x[i] = rays.hit.Ng_y[i] = rays.hit.Ng_z[i] = 0;
    }
    ask.trace(valid, scene, &rays);
    for (int i = 0; i < 16; ++i) {
      const float x = rays.hit.Ng_x[i], y = rays.hit.Ng_y[i], z = rays.hit.Ng_z[i];
      const float scale = 1 / std::sqrt(std::max(x * x + y * y + z * z, 1e-37f));
      rays.hit.Ng_x[i] *= scale, rays.hit.Ng_y[i] *= scale, rays.hit.Ng_z[i] *= scale;
    }
  }

  void store(int i, const Image& image, size_t at) const {
    image.t[at] = rays.ray.tfar[i];
    image.primitive[at] = int(rays.hit.primID[i]);
    image.normal[3 * at] = rays.hit.Ng_x[i];
    image.normal[3 * at + 1] = rays.hit.Ng_y[i];
    image.normal[3 * at + 2] = rays.hit.Ng_z[i];
  }
};

// One block of the image, 4x4 pixels at a time. directions: of a lens's rays, pixel by pixel, or nullptr.
void trace_block(const Embree& e, const Camera& c, const float* directions, const Image& image, int column0,
                 int row0) {
  Ask ask;
  Packet packet;
  for (int k = 0; k < 3; ++k) {
    std::fill_n(packet.org[k], 16, c.eye[k]);
    std::fill_n(packet.dir[k], 16, c.forward[k]);
  }
  float** const varies = c.parallel ? packet.org : packet.dir;
  const float* const base = c.parallel ? c.eye : c.forward;
  const int columns = std::min(c.width, column0 + BLOCK), rows = std::min(c.height, row0 + BLOCK);
  for (int row = row0; row < rows; row += 4)
    for (int column = column0; column < columns; column += 4) {
      for (int i = 0; i < 16; ++i) {
        const int down = row + i / 4, right = column + i % 4;
        packet.valid[i] = down < rows && right < columns ? -1 : 0;
        if (directions) {
          const size_t at = 3 * (size_t(std::min(down, c.height - 1)) * c.width + std::min(right, c.width - 1));
          for (int k = 0; k < 3; ++k) varies[k][i] = directions[at + k];
          continue;
        }
        const float x = c.left + (right + 0.5f) * c.dx, y = c.top + (down + 0.5f) * c.dy;
        for (int k = 0; k < 3; ++k) varies[k][i] = base[k] + x * c.u[k] + y * c.v[k];
      }
      packet.trace(ask, e.scene);
      for (int i = 0; i < 16; ++i)
        if (packet.valid[i]) packet.store(i, image, size_t(row + i / 4) * c.width + column + i % 4);
    }
}

}  // namespace

extern "C" {

const char* embree_version() { return RTC_VERSION_STRING; }

// quality: RTCBuildQuality; robust: whether rays may not slip between triangles. nullptr: it failed.
Embree* embree_new(const float* vertices, size_t vertex_count, const unsigned* faces, size_t face_count,
                   int threads, int quality, int robust) {
  Embree* e = new Embree(threads);
  RTCGeometry mesh = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* v = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertex_count);
  void* f = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, face_count);
  std::memcpy(v, vertices, 12 * vertex_count);
  std::memcpy(f, faces, 12 * face_count);
  rtcSetGeometryBuildQuality(mesh, RTCBuildQuality(quality));
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(e->scene, mesh);
  rtcReleaseGeometry(mesh);
  rtcSetSceneBuildQuality(e->scene, RTCBuildQuality(quality));
  rtcSetSceneFlags(e->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcCommitScene(e->scene);
  if (rtcGetDeviceError(e->device) == RTC_ERROR_NONE) return e;
  delete e;
  return nullptr;
}

void embree_free(Embree* e) { delete e; }

void embree_image(Embree* e, const Camera* camera, const float* directions, Image image) {
  const size_t across = (camera->width + BLOCK - 1) / BLOCK, down = (camera->height + BLOCK - 1) / BLOCK;
  e->share(across * down, 1, [&](size_t block, size_t) {
    trace_block(*e, *camera, directions, image, int(block % across) * BLOCK, int(block / across) * BLOCK);
  });
}

}  // extern "C"
