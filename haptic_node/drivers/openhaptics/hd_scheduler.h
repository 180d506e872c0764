#pragma once
// libHD has one scheduler thread for all devices of a process, and wants every device to be opened while it rests.

#include <functional>
#include <string>

#include "haptic_node/drivers/openhaptics/hd.h"

namespace palpate::haptic::openhaptics {

/// libHD, loaded on the first call for that file, which may be empty: the usual names.
/// @throws kit::Trouble (HDEV_E_SDK) if it is missing
const Hd& shared_hd(const std::string& file);

/// Opens a device and lets the scheduler call `frame(user)` in every tick, as the first of all.
struct ScheduledDevice {
  HHD device = HD_INVALID_HANDLE;
  HDhandle frame = 0;
};

/// @param prepare  called with the new device as the current one, before the first frame; may throw
/// @param opened   filled in before the first frame
/// @throws kit::Trouble with the vendor's words
void open_scheduled(const Hd& hd, const std::string& name, unsigned long rate_Hz, HDCallback frame,
                    void* user, void (*prepare)(void* user), ScheduledDevice& opened);

/// Ends the frames of this device, and leaves the others running.
/// @param last_act  with the device as the current one and the scheduler at rest. @return whether it is still to be disabled
void close_scheduled(const Hd& hd, const ScheduledDevice& device, const std::function<bool()>& last_act);

}  // namespace palpate::haptic::openhaptics
